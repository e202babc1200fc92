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

/// A view of a run as JSON: state, settings, the shape's outline and numbers, the points of the curves that
/// come with it. In SI units, which the keys end in.
std::string frame_json(const BoardView& view, const std::vector<CurvePoint>& curve, const FrameQuery& query);

}  // namespace wheelwright
