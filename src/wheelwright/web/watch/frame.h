#pragma once

#include <optional>
#include <string>

#include "wheelwright/web/watch/board.h"

namespace wheelwright {

/// What a page requests.
struct FrameQuery {
  int position = 0;   ///< the load position whose contact pressure it shows
  int load_case = 0;  ///< index of the load case in the case
  bool wants_force_curve = false;
  bool wants_initial_outline = false;
};

/// A view of a run as JSON: state, settings, the shape's numbers, the new points of the curves and, if dim =
/// 2, the outline (that of a proposed shape, if there is one). In SI units, named at the end of the keys.
template <int dim>
std::string frame_json(const BoardView<dim>& view, const std::vector<HistoryPoint>& curve,
                       const FrameQuery& query);

/// The newest shape at one load position of a load case as JSON, deformed and coloured by stress: its number,
/// the largest travel of the rim, its undeformed outline if dim = 2, and the fields as written by
/// loaded_wheel(). In SI units.
template <int dim>
std::string loaded_json(const BoardView<dim>& view, int load_case, int position);

}  // namespace wheelwright
