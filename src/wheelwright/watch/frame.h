#pragma once

#include <optional>
#include <string>

#include "wheelwright/watch/board.h"

namespace wheelwright {

/// What a page wants to see.
struct FrameQuery {
  int position = 0;   ///< the load position whose contact pressure it shows
  int load_case = 0;  ///< under which: its place in the case
  bool wants_force_curve = false;
  bool wants_initial_outline = false;
};

/// A view of a run as JSON: state, settings, the shape's numbers and, when dim = 2, its outline (that of a
/// proposed shape, if there is one), the points of the curves that come with it. In SI units, which the keys
/// end in.
template <int dim>
std::string frame_json(const BoardView<dim>& view, const std::vector<CurvePoint>& curve,
                       const FrameQuery& query);

/// The newest shape in one load position of a load case as JSON, deformed and coloured by stress: which it
/// is, the largest travel of the rim, its outline before the deformation when dim = 2, and the fields as
/// loaded_wheel() writes them. In SI units.
template <int dim>
std::string loaded_json(const BoardView<dim>& view, int load_case, int position);

}  // namespace wheelwright
