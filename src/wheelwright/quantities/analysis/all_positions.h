#pragma once

#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The source of a load position's state: a position that was solved for, or the mirror image of that
/// state in the plane of azimuth 0.
struct PositionSource {
  int solved;     ///< index of a solved position
  bool is_image;  ///< whether its state must be reflected
};

/// The sources of all n load positions of a sector. If a position was omitted because another represents it,
/// position i is the image of position n - i. (In the plane of azimuth 0, the image of position n - i lies a
/// sector before position i.)
std::vector<PositionSource> position_sources(const LoadPositions& solved, int n);

/// The state of a shape with all positions solved, under the same load, from one in which some stand for
/// their images. Fails as StateSolver::states() does.
template <int dim>
Expected<std::shared_ptr<const State<dim>>> on_all_positions(const StateSolver<dim>& solver,
                                                             const LevelSet<dim>& psi,
                                                             const State<dim>& state);

}  // namespace wheelwright
