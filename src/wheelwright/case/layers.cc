#include "wheelwright/case/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// The layers in the order of their radii, by their indices.
std::vector<std::size_t> outward(const Case& c) {
  std::vector<std::size_t> order(c.layers.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return radii(c, c.layers[i]).inner; });
  return order;
}

Material material_of(const Case& c, const MaterialLayer& layer) {
  return {layer.youngs_modulus, layer.poissons_ratio, c.material.plane, layer.density};
}

}  // namespace

LayerRadii radii(const Case& c, const MaterialLayer& layer) {
  return {layer.inner_radius.value_or(c.wheel.inner_radius),
          layer.outer_radius.value_or(c.wheel.outer_radius)};
}

std::string name_of_layer(const Case& c, std::size_t layer) {
  const std::string& name = c.layers[layer].name;
  return name.empty() ? "layer " + std::to_string(layer + 1) : name;
}

std::vector<PlacedMaterial> placed_materials(const Case& c) {
  const char* own_name = "material";
  if (c.layers.empty())
    return {{own_name, c.wheel.inner_radius, c.wheel.outer_radius, c.material, std::nullopt}};
  std::vector<PlacedMaterial> result;
  int n_rests = 0;
  double radius = c.wheel.inner_radius;
  const double least = 1e-9 * c.wheel.outer_radius;
  const auto fill = [&](double to) {
    if (!(to > radius + least)) return;
    result.push_back({++n_rests == 1 ? own_name : fmt::format("{} {}", own_name, n_rests), radius, to,
                      c.material, std::nullopt});
  };
  for (const std::size_t i : outward(c)) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    fill(inner);
    result.push_back({name_of_layer(c, i), inner, outer, material_of(c, c.layers[i]), i});
    radius = outer;
  }
  fill(c.wheel.outer_radius);
  return result;
}

std::vector<std::string> names_of_layers(const Case& c) {
  std::vector<std::string> names;
  if (!c.layers.empty())
    for (const PlacedMaterial& placed : placed_materials(c)) names.push_back(placed.name);
  return names;
}

Quantity in_layer(const Case& c, const Quantity& of_ring, const std::string& layer) {
  if (layer.empty()) return of_ring;
  const auto placed = placed_materials(c);
  const auto found = std::ranges::find(placed, layer, &PlacedMaterial::name);
  if (found == placed.end()) return of_ring;
  return in_part(of_ring, {layer, found->inner_radius, found->outer_radius});
}

std::vector<Expectation> placed_expectations(const Case& c) {
  std::vector<Expectation> result = c.expectations;
  for (Expectation& expectation : result) expectation.quantity = quantity_of(c, expectation);
  return result;
}

Quantity minimized_quantity(const Case& c) { return in_layer(c, c.objective.minimize, c.objective.layer); }

template <int dim>
Materials<dim> materials(const Case& c) {
  if (c.layers.empty()) return c.material;
  std::vector<typename Materials<dim>::Layer> layers;
  for (const PlacedMaterial& placed : placed_materials(c))
    layers.push_back(
        {placed.outer_radius, std::make_shared<IsotropicLaw<dim>>(placed.material), placed.name});
  return Materials<dim>(std::move(layers));
}

bool layers_fit(const Case& c, int radial_cells) {
  const PolarGrid<2> grid{c.wheel.inner_radius, c.wheel.outer_radius, c.wheel.width, 1, {radial_cells, 1}};
  return materials<2>(c).fit(grid);
}

bool has_density(const Case& c, const std::optional<PartOfRing>& part) {
  return std::ranges::all_of(placed_materials(c), [&](const PlacedMaterial& placed) {
    return (part && placed.name != part->name) || placed.material.density.has_value();
  });
}

Material tread_material(const Case& c) { return placed_materials(c).back().material; }

double modulus_at(const Case& c, double radius) {
  return materials<2>(c).at_radius(radius).contact_modulus();
}

double contact_modulus(const Case& c, double half_width) {
  double compliance = 0;
  for (const PlacedMaterial& placed : placed_materials(c)) {
    const auto share = [&](double radius) { return std::exp((radius - c.wheel.outer_radius) / half_width); };
    const double below = placed.inner_radius > c.wheel.inner_radius ? share(placed.inner_radius) : 0;
    compliance += (share(placed.outer_radius) - below) / placed.material.contact_modulus();
  }
  return 1 / compliance;
}

template decltype(materials<2>) materials<2>;
template decltype(materials<3>) materials<3>;

}  // namespace wheelwright
