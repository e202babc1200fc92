#include "wheelwright/quantities/functionals/strain_energy.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> StrainEnergy<dim>::evaluate(const StateSolver<dim>&, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix&) const {
  const auto& energy = state.strain_energy();
  return {
      .by_position = energy,
      .derivative = {.energy = std::vector<double>(energy.size(), 1.0), .tread_loads = {}, .integrals = {}}};
}

template class StrainEnergy<2>;
template class StrainEnergy<3>;

}  // namespace wheelwright
