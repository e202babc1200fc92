#pragma once

#include <string>
#include <variant>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/case_key.h"
#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/state/cooling.h"

namespace wheelwright {

/// An annulus of the ring of one material.
struct PlacedMaterial {
  std::string name;  ///< of the layer; "material" for what lies in none, if several "material 2" and so on
  double inner_radius, outer_radius;  ///< [m]
  std::variant<Material, OrthotropicMaterial> material;
  std::optional<std::size_t> layer;  ///< of the case; nothing for what lies in none
  LargeStrainConstants large = {};

  /// Its constants; null if it is of the other kind.
  const Material* isotropic() const { return std::get_if<Material>(&material); }
  const OrthotropicMaterial* orthotropic() const { return std::get_if<OrthotropicMaterial>(&material); }

  /// Young's modulus; that along the radius of an orthotropic material [Pa].
  double youngs_modulus() const;
  /// E* of Hertz's theory [Pa].
  double contact_modulus() const;
  std::optional<double> density() const;  ///< [kg/m^3]
  std::optional<LossFactor> loss_factor() const;
  std::optional<double> fatigue_limit() const;  ///< FatigueStrength::limit
  std::optional<double> fatigue_exponent() const;
  std::optional<double> conductivity() const;  ///< [W/(m K)]
  /// The least share of a unit compliance: near 0 elements lock. 1 - 2 nu of an isotropic material in plane
  /// strain.
  double least_compliance() const;

  CaseKey youngs_modulus_key() const;
  CaseKey poissons_ratio_key() const;  ///< that of radius and azimuth of an orthotropic material
  CaseKey loss_factor_key() const;
  CaseKey model_key() const;
  CaseKey second_share_key() const;
};

/// Whether a material of the ring deforms by large strains, so that the whole wheel is computed so.
bool has_large_strains(const Case& c);

/// The same case with linear elasticity everywhere.
Case with_small_strains(Case c);

/// Whether losses or fatigue are computed, which need the history of strains over a turn.
bool needs_history(const Case& c);

/// The default of contact.gamma_0 at large deformation: with theta = 0 it must be larger than in the
/// symmetric form.
inline constexpr double gamma_0_of_large_strains = 20;

using OrthotropicConstant = std::optional<double> OrthotropicConstants::*;

/// The constants that every orthotropic material of the case must have.
std::vector<OrthotropicConstant> needed_constants(const Case& c);

/// Those that the case gives for a layer, or for what lies in none.
const OrthotropicConstants& orthotropic_constants(const Case& c, const std::optional<std::size_t>& layer);

/// The keys of Young's moduli of all materials of the ring.
CaseKeys keys_of_moduli(const Case& c);

/// The key of a constant of a layer, or of what lies in none.
CaseKey key_of_constant(const std::optional<std::size_t>& layer, OrthotropicConstant constant);

/// The constants of fatigue of a layer, or of what lies in none.
const FatigueConstants& fatigue_constants(const Case& c, const std::optional<std::size_t>& layer);
/// The key of a member that RingMaterial and MaterialLayer have from FatigueConstants.
template <class Value>
CaseKey key_of_fatigue(const std::optional<std::size_t>& layer, Value FatigueConstants::*constant) {
  if (!layer) return key_of(static_cast<Value RingMaterial::*>(constant));
  return key_of(static_cast<Value MaterialLayer::*>(constant), *layer);
}

/// The radii between which a layer of the case lies.
struct LayerRadii {
  double inner, outer;  ///< [m]
};
LayerRadii radii(const Case& c, const MaterialLayer& layer);

/// The name of a layer, or "layer 2" for the second one if it has none.
std::string name_of_layer(const Case& c, std::size_t layer);

/// The orthotropic material of a layer, or of what lies in none, with the constants of an isotropic one where
/// they are missing; nothing if it is isotropic.
std::optional<OrthotropicMaterial> orthotropic_material(const Case& c,
                                                        const std::optional<std::size_t>& layer);

/// The ring from the rim to the tread: the layers of the case, and the material of the rest between them. The
/// layers must not overlap. Orthotropic materials that are not stable are shown without Poisson's ratios.
std::vector<PlacedMaterial> placed_materials(const Case& c);

/// The names by which a case can refer to parts of the ring: those of the placed materials; none if there is
/// only one.
std::vector<std::string> names_of_layers(const Case& c);

/// The quantity of a layer, by its name; if that is empty or there is no such layer, of the whole ring.
Quantity in_layer(const Case& c, const Quantity& of_ring, const std::string& layer);

/// The quantity that a table of the case names, of its layer if it names one.
template <class Table>
Quantity quantity_of(const Case& c, const Table& table) {
  return in_layer(c, table.quantity, table.layer);
}

/// The expectations of the case, each with the quantity of its layer.
std::vector<Expectation> placed_expectations(const Case& c);

/// What is minimized instead of the weighted sum.
Quantity minimized_quantity(const Case& c);

/// The same for the mechanics.
template <int dim>
Materials<dim> materials(const Case& c);

/// The radii [m] at which lines of the grid must lie, outwards: those where materials meet and those of
/// cords. If there are any, also that of the inner edge of the annulus, if it is given. Empty if they do not
/// lie in the ring.
std::vector<double> radii_of_lines(const Case& c);

/// Whether the density of every material of the ring is known, or that of a part's.
bool has_density(const Case& c, const std::optional<PartOfRing>& part = {});

/// The same of the loss factor.
bool has_loss_factor(const Case& c, const std::optional<PartOfRing>& part = {});
bool has_fatigue_limit(const Case& c, const std::optional<PartOfRing>& part = {});
bool has_fatigue_exponent(const Case& c);
bool has_conductivity(const Case& c);

/// How a wheel gives its heat away; nothing if nothing takes it.
std::optional<Cooling> cooling(const Case& c);

/// The material at the tread.
PlacedMaterial tread_material(const Case& c);

/// E* of the material at a radius [Pa].
double modulus_at(const Case& c, double radius);

/// E* of Hertz's theory [Pa] for a contact of this half-width [m]: that of the tread, or with layers an
/// estimate. The indentation of a layer between the depths z1 and z2 below the tread counts with the share
/// exp(-z1/a) - exp(-z2/a) of that of a half-space, as Doerner and Nix do for one layer on a substrate.
double contact_modulus(const Case& c, double half_width);

}  // namespace wheelwright
