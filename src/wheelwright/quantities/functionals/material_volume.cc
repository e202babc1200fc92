#include "wheelwright/quantities/functionals/material_volume.h"

#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> MaterialVolume<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                   const State<dim>& state, const Matrix&) const {
  const auto measure = [&](const CutDomain<dim>& domain) {
    return material_measure(domain, solver.model().degree);
  };
  return {.of_shape = measure(state.domain()),
          .gradient_of_shape = std::vector<double>(state.boundary().size(), 1.0),
          .by_radius_of_shape = by_radii<dim>(solver.model(), state.domain(), measure)};
}

template class MaterialVolume<2>;
template class MaterialVolume<3>;

}  // namespace wheelwright
