#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/mechanics/elasticity/materials.h"

namespace wheelwright {

/// An annulus of the ring of one material.
struct PlacedMaterial {
  std::string name;  ///< of the layer; "material" for what lies in none, if several "material 2" and so on
  double inner_radius, outer_radius;  ///< [m]
  Material material;
  std::optional<std::size_t> layer;  ///< of the case; nothing for what lies in none
};

/// The radii between which a layer of the case lies.
struct LayerRadii {
  double inner, outer;  ///< [m]
};
LayerRadii radii(const Case& c, const MaterialLayer& layer);

/// The name of a layer, or "layer 2" for the second one if it has none.
std::string name_of_layer(const Case& c, std::size_t layer);

/// The ring from the rim to the tread: the layers of the case, and the material of the rest between them. The
/// layers must not overlap.
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

/// Whether with this many radial cells the layers end on lines of the grid.
bool layers_fit(const Case& c, int radial_cells);

/// Whether the density of every material of the ring is known, or that of a part's.
bool has_density(const Case& c, const std::optional<PartOfRing>& part = {});

/// The material at the tread.
Material tread_material(const Case& c);

/// E* of the material at a radius [Pa].
double modulus_at(const Case& c, double radius);

/// E* of Hertz's theory [Pa] for a contact of this half-width [m]: that of the tread, or with layers an
/// estimate. The indentation of a layer between the depths z1 and z2 below the tread counts with the share
/// exp(-z1/a) - exp(-z2/a) of that of a half-space, as Doerner and Nix do for one layer on a substrate.
double contact_modulus(const Case& c, double half_width);

}  // namespace wheelwright
