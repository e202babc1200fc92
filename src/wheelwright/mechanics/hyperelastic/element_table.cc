#include "wheelwright/mechanics/hyperelastic/element_table.h"

#include <algorithm>

#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"

namespace wheelwright {

template <int dim>
Expected<LargeStrainLaw> large_strain_law(const MaterialLaw<dim>& law) {
  std::optional<LargeStrainLaw> found;
  if (const auto* hyperelastic = dynamic_cast<const HyperelasticLaw<dim>*>(&law))
    found = {hyperelastic->stored_energy(), hyperelastic->small_strains()};
  else if (const Material* isotropic = law.isotropic())
    found = {StoredEnergy::of(*isotropic, EnergyForm::small_strain), *isotropic};
  if (!found)
    return Failure{FailureReason::unsupported_model,
                   "large deformation is known for isotropic materials only"};
  if (dim == 3 && found->energy.plane == Plane::stress)
    return Failure{FailureReason::unsupported_model, "plane stress is for two dimensions only"};
  return *found;
}

template <int dim>
Materials<dim> for_small_strains(const Materials<dim>& materials) {
  auto layers = materials.layers();
  for (auto& layer : layers)
    if (const auto* hyperelastic = dynamic_cast<const HyperelasticLaw<dim>*>(layer.law.get()))
      layer.law = std::make_shared<IsotropicLaw<dim>>(hyperelastic->small_strains());
  return Materials<dim>(std::move(layers), materials.cords());
}

template <int dim>
Expected<HyperelasticTable<dim>> HyperelasticTable<dim>::create(const PolarGrid<dim>& grid, int degree,
                                                                const Materials<dim>& materials,
                                                                const GhostPenalty& ghost,
                                                                DilatationKind dilatation) {
  if (!materials.cords().empty())
    return Failure{FailureReason::unsupported_model, "large deformation does not know cords"};
  HyperelasticTable table;
  table.grid_ = grid;
  table.degree_ = degree;
  table.ghost_ = ghost;
  const auto rule = unit_cell_rule<dim>(degree + 2);
  for (int row = 0; row < grid.cells[0]; ++row) {
    const auto law = large_strain_law<dim>(materials.in_row(grid, row));
    if (!law) return law.failure();
    table.elements_.emplace_back(grid, degree, row, law->energy, law->small_strains, dilatation);
    table.full_cells_.push_back(table.elements_.back().points(rule));
    table.interfaces_.push_back(row + 1 < grid.cells[0] && materials.is_interface(grid, row));
    const auto& element = table.elements_.back().small_strains();
    table.fillings_.push_back(gradient_stiffness<dim>(element, IsotropicLaw<dim>(law->small_strains), rule));
    for (double& x : table.fillings_.back().entries()) x *= 1e-6;
  }
  for (int row = 0; row < grid.cells[0]; ++row)
    for (int axis = 0; axis < dim; ++axis) {
      const int plus = axis == 0 ? std::min(row + 1, grid.cells[0] - 1) : row;
      table.ghosts_.push_back(gradient_ghost_stiffness<dim>(
          table.elements_[row].small_strains(), table.elements_[plus].small_strains(), axis,
          axis == 1 ? grid.column_angle() : 0.0, materials.in_row(grid, row).scaling_modulus(), ghost));
    }
  return table;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                \
  template decltype(large_strain_law<dim>) large_strain_law<dim>;   \
  template decltype(for_small_strains<dim>) for_small_strains<dim>; \
  template class HyperelasticTable<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
