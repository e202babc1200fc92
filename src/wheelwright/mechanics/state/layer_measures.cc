#include "wheelwright/mechanics/state/layer_measures.h"

#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
std::vector<double> layer_measures(const Materials<dim>& materials, int degree, const CutDomain<dim>& shape,
                                   const std::function<bool(int)>& counts) {
  const auto n_layers = materials.layers().size();
  std::vector<int> layer_of_row;
  for (int row = 0; row < shape.grid.cells[0]; ++row)
    layer_of_row.push_back(counts(row) ? materials.layer_at(shape.grid.middle_of_row(row))
                                       : static_cast<int>(n_layers));
  auto parts = measures_by_annulus<dim>(shape, degree, layer_of_row);
  parts.resize(n_layers);
  return parts;
}

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
  const std::vector<double> parts = layer_measures(materials, degree, *domain);
  for (std::size_t layer = 0; layer < parts.size(); ++layer) {
    mass += parts[layer] * *layers[layer].law->density();
    volume += parts[layer];
  }
  return mass / volume;
}

template <int dim>
std::vector<std::optional<double>> layer_masses(const RollingModel<dim>& model, const CutDomain<dim>& shape) {
  const std::vector<double> parts = layer_measures(model.materials, model.degree, shape);
  std::vector<std::optional<double>> masses;
  for (std::size_t layer = 0; layer < parts.size(); ++layer) {
    const auto density = model.materials.layers()[layer].law->density();
    masses.push_back(density ? std::optional(parts[layer] * *density * model.grid.n_sectors) : std::nullopt);
  }
  return masses;
}

template decltype(layer_measures<2>) layer_measures<2>;
template decltype(layer_measures<3>) layer_measures<3>;
template decltype(mean_density<2>) mean_density<2>;
template decltype(mean_density<3>) mean_density<3>;
template decltype(layer_masses<2>) layer_masses<2>;
template decltype(layer_masses<3>) layer_masses<3>;

}  // namespace wheelwright
