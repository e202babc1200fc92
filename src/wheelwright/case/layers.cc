#include "wheelwright/case/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"

namespace wheelwright {
namespace {

/// The layers in the order of their radii, by their indices.
std::vector<std::size_t> outward(const Case& c) {
  std::vector<std::size_t> order(c.layers.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return radii(c, c.layers[i]).inner; });
  return order;
}

std::optional<FatigueStrength> fatigue_strength(const FatigueConstants& given) {
  const bool is_of_strain = given.fatigue_measure == FatigueMeasure::principal_strain;
  const auto limit = is_of_strain ? given.fatigue_strain : given.fatigue_limit;
  if (given.fatigue_measure == FatigueMeasure::none || !limit) return {};
  return FatigueStrength{.measure = given.fatigue_measure,
                         .limit = *limit,
                         .cycles = given.fatigue_cycles,
                         .exponent = given.fatigue_exponent,
                         .pressure_factor = given.fatigue_pressure_factor.value_or(0),
                         .ultimate_strength = given.ultimate_strength};
}

Material isotropic_material(const Case& c, const std::optional<std::size_t>& layer) {
  Material material = c.material;
  if (layer) {
    const MaterialLayer& from = c.layers[*layer];
    material = {from.youngs_modulus, from.poissons_ratio, c.material.plane, from.density, from.loss_factor};
    material.conductivity = from.conductivity;
    material.maximum_temperature = from.maximum_temperature;
  }
  material.fatigue = fatigue_strength(fatigue_constants(c, layer));
  return material;
}

std::variant<Material, OrthotropicMaterial> material_of(const Case& c,
                                                        const std::optional<std::size_t>& layer) {
  auto orthotropic = orthotropic_material(c, layer);
  if (!orthotropic) return isotropic_material(c, layer);
  if (!orthotropic->is_stable()) orthotropic->ratio_rt = orthotropic->ratio_rz = orthotropic->ratio_tz = 0;
  return *orthotropic;
}

EnergyForm energy_form(MaterialModel model) {
  switch (model) {
    case MaterialModel::neo_hookean:
      return EnergyForm::neo_hookean;
    case MaterialModel::saint_venant_kirchhoff:
      return EnergyForm::saint_venant_kirchhoff;
    case MaterialModel::mooney_rivlin:
      return EnergyForm::mooney_rivlin;
    default:
      return EnergyForm::small_strain;
  }
}

template <int dim>
std::shared_ptr<const MaterialLaw<dim>> law_of(const PlacedMaterial& placed) {
  if (const OrthotropicMaterial* material = placed.orthotropic())
    return std::make_shared<OrthotropicLaw<dim>>(*material);
  const auto [model, second_share] = placed.large;
  if (model == MaterialModel::small_strain) return std::make_shared<IsotropicLaw<dim>>(*placed.isotropic());
  return std::make_shared<HyperelasticLaw<dim>>(*placed.isotropic(), energy_form(model), second_share);
}

}  // namespace

std::optional<OrthotropicMaterial> orthotropic_material(const Case& c,
                                                        const std::optional<std::size_t>& layer) {
  const OrthotropicConstants& given = orthotropic_constants(c, layer);
  if (given == OrthotropicConstants()) return {};
  const Material isotropic = isotropic_material(c, layer);
  const double e = isotropic.youngs_modulus, nu = isotropic.poissons_ratio, g = e / (2 * (1 + nu));
  return OrthotropicMaterial{.modulus_r = given.youngs_modulus_radial.value_or(e),
                             .modulus_t = given.youngs_modulus_azimuthal.value_or(e),
                             .modulus_z = given.youngs_modulus_axial.value_or(e),
                             .ratio_rt = given.poissons_ratio_radial_azimuthal.value_or(nu),
                             .ratio_rz = given.poissons_ratio_radial_axial.value_or(nu),
                             .ratio_tz = given.poissons_ratio_azimuthal_axial.value_or(nu),
                             .shear_rt = given.shear_modulus_radial_azimuthal.value_or(g),
                             .shear_rz = given.shear_modulus_radial_axial.value_or(g),
                             .shear_tz = given.shear_modulus_azimuthal_axial.value_or(g),
                             .plane = isotropic.plane,
                             .density = isotropic.density,
                             .loss_factor = isotropic.loss_factor,
                             .fatigue = isotropic.fatigue,
                             .conductivity = isotropic.conductivity,
                             .maximum_temperature = isotropic.maximum_temperature};
}

double PlacedMaterial::youngs_modulus() const {
  return isotropic() ? isotropic()->youngs_modulus : orthotropic()->modulus_r;
}

double PlacedMaterial::contact_modulus() const {
  return std::visit([](const auto& m) { return m.contact_modulus(); }, material);
}

std::optional<double> PlacedMaterial::density() const {
  return std::visit([](const auto& m) { return m.density; }, material);
}

std::optional<LossFactor> PlacedMaterial::loss_factor() const {
  return std::visit([](const auto& m) { return m.loss_factor; }, material);
}

std::optional<double> PlacedMaterial::fatigue_limit() const {
  return std::visit([](const auto& m) { return m.fatigue ? std::optional(m.fatigue->limit) : std::nullopt; },
                    material);
}

std::optional<double> PlacedMaterial::fatigue_exponent() const {
  return std::visit([](const auto& m) { return m.fatigue ? m.fatigue->exponent : std::nullopt; }, material);
}

std::optional<double> PlacedMaterial::conductivity() const {
  return std::visit([](const auto& m) { return m.conductivity; }, material);
}

double PlacedMaterial::least_compliance() const {
  return isotropic() ? 1 - 2 * isotropic()->plane_strain_equivalent().poissons_ratio
                     : orthotropic()->least_compliance();
}

CaseKey PlacedMaterial::youngs_modulus_key() const {
  if (orthotropic()) return key_of_constant(layer, &OrthotropicConstants::youngs_modulus_radial);
  return layer ? key_of(&MaterialLayer::youngs_modulus, *layer) : key_of(&Material::youngs_modulus);
}

CaseKeys keys_of_moduli(const Case& c) {
  CaseKeys keys;
  for (const PlacedMaterial& placed : placed_materials(c)) keys.push_back(placed.youngs_modulus_key());
  return keys;
}

CaseKey PlacedMaterial::poissons_ratio_key() const {
  if (orthotropic()) return key_of_constant(layer, &OrthotropicConstants::poissons_ratio_radial_azimuthal);
  return layer ? key_of(&MaterialLayer::poissons_ratio, *layer) : key_of(&Material::poissons_ratio);
}

CaseKey PlacedMaterial::model_key() const {
  if (!layer) return key_of(static_cast<MaterialModel RingMaterial::*>(&LargeStrainConstants::model));
  return key_of(static_cast<MaterialModel MaterialLayer::*>(&LargeStrainConstants::model), *layer);
}

CaseKey PlacedMaterial::second_share_key() const {
  if (!layer) return key_of(static_cast<double RingMaterial::*>(&LargeStrainConstants::second_share));
  return key_of(static_cast<double MaterialLayer::*>(&LargeStrainConstants::second_share), *layer);
}

bool has_large_strains(const Case& c) {
  return std::ranges::any_of(placed_materials(c), [](const PlacedMaterial& placed) {
    return placed.large.model != MaterialModel::small_strain;
  });
}

bool needs_history(const Case& c) {
  return std::ranges::any_of(placed_materials(c), [](const PlacedMaterial& placed) {
    return placed.loss_factor().has_value() || placed.fatigue_limit().has_value();
  });
}

Case with_small_strains(Case c) {
  c.material.model = MaterialModel::small_strain;
  for (MaterialLayer& layer : c.layers) layer.model = MaterialModel::small_strain;
  return c;
}

CaseKey PlacedMaterial::loss_factor_key() const {
  return layer ? key_of(&MaterialLayer::loss_factor, *layer) : key_of(&Material::loss_factor);
}

std::vector<OrthotropicConstant> needed_constants(const Case& c) {
  using Constants = OrthotropicConstants;
  std::vector<OrthotropicConstant> needed{
      &Constants::youngs_modulus_radial,         &Constants::youngs_modulus_azimuthal,
      &Constants::youngs_modulus_axial,          &Constants::poissons_ratio_radial_azimuthal,
      &Constants::poissons_ratio_radial_axial,   &Constants::poissons_ratio_azimuthal_axial,
      &Constants::shear_modulus_radial_azimuthal};
  if (c.wheel.dimension == 3) {
    needed.push_back(&Constants::shear_modulus_radial_axial);
    needed.push_back(&Constants::shear_modulus_azimuthal_axial);
  }
  return needed;
}

const OrthotropicConstants& orthotropic_constants(const Case& c, const std::optional<std::size_t>& layer) {
  if (layer) return c.layers[*layer];
  return c.material;
}

const FatigueConstants& fatigue_constants(const Case& c, const std::optional<std::size_t>& layer) {
  if (!layer) return c.material;
  return c.layers[*layer];
}

CaseKey key_of_constant(const std::optional<std::size_t>& layer, OrthotropicConstant constant) {
  if (!layer) return key_of(static_cast<std::optional<double> RingMaterial::*>(constant));
  return key_of(static_cast<std::optional<double> MaterialLayer::*>(constant), *layer);
}

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
    return {
        {own_name, c.wheel.inner_radius, c.wheel.outer_radius, material_of(c, {}), std::nullopt, c.material}};
  std::vector<PlacedMaterial> result;
  int n_rests = 0;
  double radius = c.wheel.inner_radius;
  const double least = 1e-9 * c.wheel.outer_radius;
  const auto fill = [&](double to) {
    if (!(to > radius + least)) return;
    result.push_back({++n_rests == 1 ? own_name : fmt::format("{} {}", own_name, n_rests), radius, to,
                      material_of(c, {}), std::nullopt, c.material});
  };
  for (const std::size_t i : outward(c)) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    fill(inner);
    result.push_back({name_of_layer(c, i), inner, outer, material_of(c, i), i, c.layers[i]});
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
  std::vector<typename Materials<dim>::Layer> layers;
  for (const PlacedMaterial& placed : placed_materials(c))
    layers.push_back({placed.outer_radius, law_of<dim>(placed), placed.name});
  std::vector<typename Materials<dim>::Cord> cords;
  for (const MaterialCord& cord : c.cords) cords.push_back({cord.radius, cord.stiffness});
  return Materials<dim>(std::move(layers), std::move(cords));
}

std::vector<double> radii_of_lines(const Case& c) {
  if (c.layers.empty() && c.cords.empty()) return {};
  std::vector<double> radii;
  for (const PlacedMaterial& placed : placed_materials(c)) radii.push_back(placed.outer_radius);
  radii.pop_back();
  for (const MaterialCord& cord : c.cords) radii.push_back(cord.radius);
  if (c.objective.annulus && wants_annulus(c)) radii.push_back(c.wheel.outer_radius - *c.objective.annulus);
  std::ranges::sort(radii);
  const double least = 1e-9 * c.wheel.outer_radius;
  const auto is_same = [&](double a, double b) { return b - a < least; };
  radii.erase(std::unique(radii.begin(), radii.end(), is_same), radii.end());
  const bool is_inside = radii.empty() || (radii.front() > c.wheel.inner_radius + least &&
                                           radii.back() < c.wheel.outer_radius - least);
  return is_inside ? radii : std::vector<double>();
}

namespace {

/// Whether every material of the ring has a constant, or that of a part.
template <class Constant>
bool all_have(const Case& c, const std::optional<PartOfRing>& part,
              std::optional<Constant> (PlacedMaterial::*constant)() const) {
  return std::ranges::all_of(placed_materials(c), [&](const PlacedMaterial& placed) {
    return (part && placed.name != part->name) || (placed.*constant)().has_value();
  });
}

}  // namespace

bool has_density(const Case& c, const std::optional<PartOfRing>& part) {
  return all_have(c, part, &PlacedMaterial::density);
}

bool has_loss_factor(const Case& c, const std::optional<PartOfRing>& part) {
  return all_have(c, part, &PlacedMaterial::loss_factor);
}

bool has_fatigue_limit(const Case& c, const std::optional<PartOfRing>& part) {
  return all_have(c, part, &PlacedMaterial::fatigue_limit);
}

bool has_fatigue_exponent(const Case& c) { return all_have(c, {}, &PlacedMaterial::fatigue_exponent); }

bool has_conductivity(const Case& c) { return all_have(c, {}, &PlacedMaterial::conductivity); }

std::optional<Cooling> cooling(const Case& c) {
  const double everywhere = c.heat.convection.value_or(0);
  const bool is_bonded = c.contact.with == Counterpart::ring;  // the air does not reach the tread
  Cooling cooling{.ambient_temperature = c.heat.ambient_temperature,
                  .rim_temperature = c.heat.rim_temperature,
                  .tread = c.heat.tread_convection.value_or(is_bonded ? 0 : everywhere),
                  .holes = c.heat.hole_convection.value_or(everywhere),
                  .side_faces = c.heat.side_convection.value_or(everywhere)};
  if (c.wheel.dimension == 3 && c.wheel.side_faces == SideFaces::symmetric) cooling.side_faces = 0;
  return cooling.any() ? std::optional(cooling) : std::nullopt;
}

PlacedMaterial tread_material(const Case& c) { return placed_materials(c).back(); }

double modulus_at(const Case& c, double radius) {
  return materials<2>(c).at_radius(radius).contact_modulus();
}

double contact_modulus(const Case& c, double half_width) {
  double compliance = 0;
  for (const PlacedMaterial& placed : placed_materials(c)) {
    const auto share = [&](double radius) { return std::exp((radius - c.wheel.outer_radius) / half_width); };
    const double below = placed.inner_radius > c.wheel.inner_radius ? share(placed.inner_radius) : 0;
    compliance += (share(placed.outer_radius) - below) / placed.contact_modulus();
  }
  return 1 / compliance;
}

template decltype(materials<2>) materials<2>;
template decltype(materials<3>) materials<3>;

}  // namespace wheelwright
