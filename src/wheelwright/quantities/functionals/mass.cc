#include "wheelwright/quantities/functionals/mass.h"

#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// The measure of every layer in one sector.
template <int dim>
std::vector<double> measures(const Materials<dim>& materials, int degree, const CutDomain<dim>& domain) {
  std::vector<int> layer_of_row;
  for (int row = 0; row < domain.grid.cells[0]; ++row)
    layer_of_row.push_back(materials.layer_at(domain.grid.middle_of_row(row)));
  return measures_by_annulus<dim>(domain, degree, layer_of_row);
}

}  // namespace

template <int dim>
std::optional<double> mean_density(const Materials<dim>& materials, const LevelSet<dim>& psi) {
  const auto& layers = materials.layers();
  for (const auto& layer : layers)
    if (!layer.law->density()) return {};
  if (layers.size() == 1) return layers.front().law->density();
  const int degree = psi.lattice.degree();
  const auto domain = cut_domain(psi, degree + 2);
  if (!domain) return {};
  double mass = 0, volume = 0;
  const std::vector<double> parts = measures(materials, degree, *domain);
  for (std::size_t layer = 0; layer < parts.size(); ++layer) {
    mass += parts[layer] * *layers[layer].law->density();
    volume += parts[layer];
  }
  return mass / volume;
}

template <int dim>
FunctionalValue<dim> Mass<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                         const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto of_sectors = [&](const MaterialLaw<dim>& law) {
    return law.density().value_or(0) * grid.n_sectors;
  };
  FunctionalValue<dim> value;
  const std::vector<double> parts = measures(materials_, solver.model().degree, state.domain());
  for (std::size_t layer = 0; layer < parts.size(); ++layer)
    value.of_shape += parts[layer] * of_sectors(*materials_.layers()[layer].law);
  for (const SurfacePoint<dim>& point : state.boundary())
    value.gradient_of_shape.push_back(of_sectors(materials_.in_row(grid, grid.cell_position(point.cell)[0])));
  return value;
}

template decltype(mean_density<2>) mean_density<2>;
template decltype(mean_density<3>) mean_density<3>;
template class Mass<2>;
template class Mass<3>;

}  // namespace wheelwright
