#include "wheelwright/quantities/functionals/material_volume.h"

#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> MaterialVolume<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                   const State<dim>& state, const Matrix&) const {
  return {.of_shape = material_measure(state.domain(), solver.model().degree),
          .gradient_of_shape = std::vector<double>(state.boundary().size(), 1.0)};
}

template class MaterialVolume<2>;
template class MaterialVolume<3>;

}  // namespace wheelwright
