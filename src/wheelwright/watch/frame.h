#pragma once

#include <optional>
#include <string>

#include "wheelwright/watch/board.h"

namespace wheelwright {

/// What a page wants to see.
struct FrameQuery {
  int position = 0;  ///< the load position whose contact pressure it shows
  bool wants_force_curve = false;
};

/// A view of a run as JSON: state, settings, the shape's numbers and, when dim = 2, its outline (that of a
/// proposed shape, if there is one), the points of the curves that come with it. In SI units, which the keys
/// end in.
template <int dim>
std::string frame_json(const BoardView<dim>& view, const std::vector<CurvePoint>& curve,
                       const FrameQuery& query);

}  // namespace wheelwright
