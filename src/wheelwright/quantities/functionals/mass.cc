#include "wheelwright/quantities/functionals/mass.h"

#include "wheelwright/quantities/functionals/material_volume.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> Mass<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                         const State<dim>& state, const Matrix& mean) const {
  FunctionalValue<dim> value = MaterialVolume<dim>().evaluate(solver, psi, state, mean);
  const double factor = density_ * solver.model().grid.n_sectors;
  value.of_shape *= factor;
  for (double& g : value.gradient_of_shape) g *= factor;
  return value;
}

template class Mass<2>;
template class Mass<3>;

}  // namespace wheelwright
