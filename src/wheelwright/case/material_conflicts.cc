#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/names.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {
namespace {

/// Elements of degree 1 lock; rounding, divided by 1 - 2 nu, spoils those of degree 2. `ratio` is the key of
/// Poisson's ratio.
void check_compressibility(const Case& c, const Material& material, const CaseKey& ratio, Conflicts& found) {
  if (!material.nearly_incompressible()) return;
  if (c.grid.degree == 1)
    found.push_back({{key_of(&Grid::degree), ratio, key_of(&Material::plane)},
                     fmt::format("elements of degree 1 are much too stiff at poissons_ratio = {}",
                                 material.poissons_ratio),
                     "use degree = 2"});
  if (c.grid.degree == 2 && c.grid.dilatation == DilatationKind::pointwise)
    found.push_back(
        {{key_of(&Grid::dilatation), ratio, key_of(&Material::plane)},
         fmt::format("elements with the dilatation of the displacement lock at poissons_ratio = {}",
                     material.poissons_ratio),
         "use dilatation = \"projected\""});
  constexpr double largest = 0.49999;
  if (material.poissons_ratio > largest)
    found.push_back({{ratio, key_of(&Material::plane)},
                     "so close to 1/2 that rounding would spoil the solution",
                     fmt::format("use at most {}: the difference to 1/2 does not matter", largest)});
}

/// Names are parts of names of files.
void check_names(const Case& c, Conflicts& found) {
  std::vector<std::string> names{"material"};
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const std::string& name = c.layers[i].name;
    if (name.empty()) continue;
    const CaseKey key = key_of(&MaterialLayer::name, i);
    if (!is_word(name))
      found.push_back({{key}, "the name must be one word of letters, digits, - and _", "use another name"});
    if (std::ranges::find(names, name) != names.end())
      found.push_back({{key},
                       name == names[0] ? "this is what lies in no layer" : "another layer has this name",
                       "use a unique name"});
    names.push_back(name);
  }
}

/// Whether every layer is an annulus within the ring; adds what is wrong.
bool check_places(const Case& c, Conflicts& found) {
  const std::size_t before = found.size();
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    const CaseKeys keys{key_of(&MaterialLayer::outer_radius, i), key_of(&MaterialLayer::inner_radius, i),
                        table_of<MaterialLayer>(i), key_of(&Wheel::inner_radius),
                        key_of(&Wheel::outer_radius)};
    if (outer <= inner)
      found.push_back({keys, fmt::format("a layer from {:.6g} m to {:.6g} m has no thickness", inner, outer),
                       "use outer_radius > inner_radius"});
    else if (inner < c.wheel.inner_radius || outer > c.wheel.outer_radius)
      found.push_back(
          {keys, fmt::format("a layer from {:.6g} m to {:.6g} m does not lie in the ring", inner, outer),
           fmt::format("the ring lies between the radii {:.6g} m and {:.6g} m", c.wheel.inner_radius,
                       c.wheel.outer_radius)});
    for (std::size_t j = 0; j < i; ++j)
      if (const auto [other_inner, other_outer] = radii(c, c.layers[j]);
          inner < other_outer && other_inner < outer)
        found.push_back(
            {keys, fmt::format("two layers overlap: {} and {}", name_of_layer(c, j), name_of_layer(c, i)),
             "let one begin where the other ends", table_of<MaterialLayer>(j)});
  }
  return found.size() == before;
}

/// The numbers of radial cells nearest to that of the case with which the layers fit; empty if there is none
/// up to four times as many.
std::string fitting_cells(const Case& c) {
  const int usual = c.grid.radial_cells;
  std::string text;
  for (int cells = usual - 1; cells >= std::max(2, usual / 2); --cells)
    if (layers_fit(c, cells)) {
      text = fmt::format("{} or ", cells);
      break;
    }
  for (int cells = usual + 1; cells <= 4 * usual; ++cells)
    if (layers_fit(c, cells)) return text + fmt::format("{}", cells);
  return text.empty() ? text : text.substr(0, text.size() - 4);
}

/// A stiff layer moves almost as a rigid body between soft ones: in its equations the forces of its
/// neighbours are smaller than its own by the contrast, which costs as many digits.
void check_contrast(const Case& c, Conflicts& found) {
  constexpr double largest = 1e9;
  const auto ring = placed_materials(c);
  const auto modulus = [](const PlacedMaterial& placed) { return placed.material.youngs_modulus; };
  const PlacedMaterial &softest = *std::ranges::min_element(ring, {}, modulus),
                       &stiffest = *std::ranges::max_element(ring, {}, modulus);
  const double ratio = modulus(stiffest) / modulus(softest);
  if (ratio <= largest) return;
  const auto key = [](const PlacedMaterial& placed) {
    return placed.layer ? key_of(&MaterialLayer::youngs_modulus, *placed.layer)
                        : key_of(&Material::youngs_modulus);
  };
  found.push_back({{key(stiffest), key(softest)},
                   fmt::format("{} is {:.2g} times as stiff as {}: rounding would spoil the solution",
                               stiffest.name, ratio, softest.name),
                   fmt::format("use at most {:.0e} times; a layer that much stiffer hardly deforms, one that "
                               "much softer hardly carries anything",
                               largest)});
}

/// Checks a table that names a layer, and the quantity that it asks of it.
template <class Table>
void check_named_layer(const Case& c, const Table& table, const Quantity& quantity, const CaseKey& layer,
                       const CaseKey& key_of_quantity, Conflicts& found) {
  if (table.layer.empty()) return;
  const std::vector<std::string> names = names_of_layers(c);
  if (std::ranges::find(names, table.layer) == names.end())
    found.push_back({{layer},
                     "there is no layer with this name",
                     names.empty() ? "add a [[material.layer]], or omit the key"
                                   : fmt::format("known: {}", fmt::join(names, ", "))});
  if (quantity->has_parts) return;
  std::vector<std::string> of_layers;
  for (const Quantity& known : c.vocabulary.quantities)
    if (known->has_parts) of_layers.push_back(name(known));
  found.push_back({{layer, key_of_quantity},
                   fmt::format("a layer has no {} of its own", name(quantity)),
                   fmt::format("omit the key; of layers there are {}", fmt::join(of_layers, ", "))});
}

/// Checks all tables that name layers.
void check_named_layers(const Case& c, Conflicts& found) {
  check_named_layer(c, c.objective, c.objective.minimize, key_of(&Objective::layer),
                    key_of(&Objective::minimize), found);
  const auto check_all = [&]<class Table>(const std::vector<Table>& tables) {
    for (std::size_t i = 0; i < tables.size(); ++i)
      check_named_layer(c, tables[i], tables[i].quantity, key_of(&Table::layer, i),
                        key_of(&Table::quantity, i), found);
  };
  check_all(c.objective.terms);
  check_all(c.constraints);
  check_all(c.expectations);
}

/// Layers must end on lines of the grid.
void check_lines(const Case& c, Conflicts& found) {
  if (layers_fit(c, c.grid.radial_cells)) return;
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius, row = ring / c.grid.radial_cells;
  const auto misfit = [&](double radius) {
    const double rows = (radius - c.wheel.inner_radius) / row;
    return std::abs(rows - std::round(rows)) >= 1e-6;
  };
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    if (!misfit(inner) && !misfit(outer)) continue;
    const double radius = misfit(inner) ? inner : outer;
    const double nearest = c.wheel.inner_radius + std::round((radius - c.wheel.inner_radius) / row) * row;
    const std::string cells = fitting_cells(c);
    found.push_back(
        {{key_of(misfit(inner) ? &MaterialLayer::inner_radius : &MaterialLayer::outer_radius, i),
          key_of(&Grid::radial_cells)},
         fmt::format("{:.6g} m lies between two lines of the grid, whose {} rows are {:.4g} mm high", radius,
                     c.grid.radial_cells, 1e3 * row),
         fmt::format("use {}{:.6g} m, the nearest line",
                     cells.empty() ? "" : fmt::format("grid.radial_cells = {}, or ", cells), nearest)});
  }
}

/// The condensed rows at the tread, of which there are several with an annulus, must be of one material.
void check_annulus(const Case& c, Conflicts& found) {
  const PlacedMaterial outermost = placed_materials(c).back();
  const double thickness = outermost.outer_radius - outermost.inner_radius;
  if (!outermost.layer && c.layers.empty()) return;
  if (!wants_annulus(c) || annulus_thickness(c) < thickness * (1 + 1e-9)) return;
  found.push_back(
      {{key_of(&Objective::annulus), key_of(&Objective::uniformity_annulus),
        table_of<MaterialLayer>(outermost.layer.value_or(0))},
       fmt::format("the annulus of {:.6g} m reaches beyond the outermost material, which is {:.6g} m "
                   "thick",
                   annulus_thickness(c), thickness),
       fmt::format("use objective.annulus <= {:.6g}", thickness)});
}

/// Whether some of the ring lies in no layer.
bool has_rest(const Case& c) {
  return std::ranges::any_of(placed_materials(c),
                             [](const PlacedMaterial& placed) { return !placed.layer.has_value(); });
}

}  // namespace

void material_conflicts(const Case& c, Conflicts& found) {
  check_names(c, found);
  if (c.wheel.inner_radius >= c.wheel.outer_radius || !check_places(c, found)) return;
  if (has_rest(c)) check_compressibility(c, c.material, key_of(&Material::poissons_ratio), found);
  for (const PlacedMaterial& placed : placed_materials(c))
    if (placed.layer)
      check_compressibility(c, placed.material, key_of(&MaterialLayer::poissons_ratio, *placed.layer), found);
  check_lines(c, found);
  check_annulus(c, found);
  check_named_layers(c, found);
  check_contrast(c, found);
}

}  // namespace wheelwright
