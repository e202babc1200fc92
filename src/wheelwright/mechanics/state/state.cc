#include "wheelwright/mechanics/state/state.h"

#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {

template <int dim>
LoadPositions StateSolver<dim>::distinct_positions(const LevelSet<dim>& psi) const {
  return is_mirror_symmetric(model()) && is_mirror_symmetric(psi)
             ? load_positions_without_images(model().grid, model().n_positions, model().camber)
             : all_positions();
}

template class StateSolver<2>;
template class StateSolver<3>;

}  // namespace wheelwright
