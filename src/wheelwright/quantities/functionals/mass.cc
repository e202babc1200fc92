#include "wheelwright/quantities/functionals/mass.h"

#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// The measure in one sector of every layer, as far as it lies in the part.
template <int dim>
std::vector<double> measures(const Materials<dim>& materials, const std::optional<PartOfRing>& part,
                             int degree, const CutDomain<dim>& domain) {
  const auto n_layers = materials.layers().size();
  std::vector<int> layer_of_row;
  for (int row = 0; row < domain.grid.cells[0]; ++row)
    layer_of_row.push_back(!part || part->has_row(domain.grid, row)
                               ? materials.layer_at(domain.grid.middle_of_row(row))
                               : static_cast<int>(n_layers));
  auto parts = measures_by_annulus<dim>(domain, degree, layer_of_row);
  parts.resize(n_layers);
  return parts;
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
  const std::vector<double> parts = measures(materials, {}, degree, *domain);
  for (std::size_t layer = 0; layer < parts.size(); ++layer) {
    mass += parts[layer] * *layers[layer].law->density();
    volume += parts[layer];
  }
  return mass / volume;
}

template <int dim>
std::vector<std::optional<double>> layer_masses(const RollingModel<dim>& model, const CutDomain<dim>& shape) {
  const std::vector<double> parts = measures(model.materials, {}, model.degree, shape);
  std::vector<std::optional<double>> masses;
  for (std::size_t layer = 0; layer < parts.size(); ++layer) {
    const auto density = model.materials.layers()[layer].law->density();
    masses.push_back(density ? std::optional(parts[layer] * *density * model.grid.n_sectors) : std::nullopt);
  }
  return masses;
}

template <int dim>
FunctionalValue<dim> Mass<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                         const State<dim>& state, const Matrix&) const {
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto of_sectors = [&](const MaterialLaw<dim>& law) {
    return law.density().value_or(0) * grid.n_sectors;
  };
  const auto mass = [&](const CutDomain<dim>& domain) {
    const std::vector<double> parts = measures(materials_, part_, solver.model().degree, domain);
    double sum = 0;
    for (std::size_t layer = 0; layer < parts.size(); ++layer)
      sum += parts[layer] * of_sectors(*materials_.layers()[layer].law);
    return sum;
  };
  FunctionalValue<dim> value{.of_shape = mass(state.domain()),
                             .by_radius_of_shape = by_radii<dim>(solver.model(), state.domain(), mass)};
  for (const SurfacePoint<dim>& point : state.boundary()) {
    const int row = grid.cell_position(point.cell)[0];
    const bool counts = !part_ || part_->has_row(grid, row);
    value.gradient_of_shape.push_back(counts ? of_sectors(materials_.in_row(grid, row)) : 0);
  }
  return value;
}

template decltype(mean_density<2>) mean_density<2>;
template decltype(mean_density<3>) mean_density<3>;
template decltype(layer_masses<2>) layer_masses<2>;
template decltype(layer_masses<3>) layer_masses<3>;
template class Mass<2>;
template class Mass<3>;

}  // namespace wheelwright
