#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

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

/// The names of keys in a sentence.
std::string listed(const CaseKeys& keys) {
  std::vector<std::string_view> names;
  for (const CaseKey& key : keys) names.push_back(key.names.front());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// All constants of an orthotropic material must be given, and the energy of every strain positive.
bool check_constants(const Case& c, const std::optional<std::size_t>& layer, Conflicts& found) {
  using Constants = OrthotropicConstants;
  const Constants& values = orthotropic_constants(c, layer);
  const auto key = [&](OrthotropicConstant constant) { return key_of_constant(layer, constant); };
  CaseKeys given, missing;
  for (const OrthotropicConstant constant : needed_constants(c))
    (values.*constant ? given : missing).push_back(key(constant));
  if (!missing.empty()) {
    found.push_back({joined({given, missing}), "an orthotropic material has more constants",
                     fmt::format("add {}, or use youngs_modulus and poissons_ratio alone", listed(missing))});
    return false;
  }
  const auto material = orthotropic_material(c, layer);
  if (!material || material->is_stable()) return true;
  const auto [rt, rz, tz] = material->couplings();
  struct Pair {
    double coupling;
    OrthotropicConstant ratio, first, second;
  };
  const Pair pairs[] = {{rt, &Constants::poissons_ratio_radial_azimuthal, &Constants::youngs_modulus_radial,
                         &Constants::youngs_modulus_azimuthal},
                        {rz, &Constants::poissons_ratio_radial_axial, &Constants::youngs_modulus_radial,
                         &Constants::youngs_modulus_axial},
                        {tz, &Constants::poissons_ratio_azimuthal_axial, &Constants::youngs_modulus_azimuthal,
                         &Constants::youngs_modulus_axial}};
  bool pairs_are_stable = true;
  CaseKeys ratios;
  for (const auto& [coupling, ratio, first, second] : pairs) {
    ratios.push_back(key(ratio));
    if (std::abs(coupling) < 1) continue;
    pairs_are_stable = false;
    const CaseKeys keys{key(ratio), key(first), key(second)};
    found.push_back(
        {keys,
         fmt::format("some strains would have negative energy: {}^2 < {} / {} is not true",
                     keys[0].names.front(), keys[1].names.front(), keys[2].names.front()),
         fmt::format("use less than {:.4g} in absolute value", std::abs(*(values.*ratio) / coupling))});
  }
  if (pairs_are_stable) {
    CaseKeys keys = ratios;
    for (const OrthotropicConstant modulus :
         {&Constants::youngs_modulus_radial, &Constants::youngs_modulus_azimuthal,
          &Constants::youngs_modulus_axial})
      keys.push_back(key(modulus));
    found.push_back(
        {keys,
         fmt::format("some strains would have negative energy: with {} the number 1 - nu_rt nu_tr - "
                     "nu_rz nu_zr - nu_tz nu_zt - 2 nu_rt nu_tz nu_zr is {:.4g} and not positive",
                     listed(ratios), material->determinant()),
         "use smaller ratios"});
  }
  return false;
}

/// A fatigue measure needs its constants; without one they have no effect.
void check_fatigue(const Case& c, const PlacedMaterial& placed, Conflicts& found) {
  using Constants = FatigueConstants;
  using Constant = std::optional<double> Constants::*;
  const Constants& given = fatigue_constants(c, placed.layer);
  const auto key = [&](auto constant) { return key_of_fatigue(placed.layer, constant); };
  const CaseKey measure = key(&Constants::fatigue_measure);
  const bool is_of_strain = given.fatigue_measure == FatigueMeasure::principal_strain,
             has_pressure = given.fatigue_measure == FatigueMeasure::crossland ||
                            given.fatigue_measure == FatigueMeasure::dang_van,
             has_mean = given.fatigue_measure == FatigueMeasure::goodman,
             is_none = given.fatigue_measure == FatigueMeasure::none;
  const std::pair<Constant, bool> needs[] = {{&Constants::fatigue_limit, !is_none && !is_of_strain},
                                             {&Constants::fatigue_strain, is_of_strain},
                                             {&Constants::fatigue_pressure_factor, has_pressure},
                                             {&Constants::ultimate_strength, has_mean}};
  for (const auto& [constant, is_needed] : needs) {
    const CaseKey needed = key(constant);
    if (is_needed && !(given.*constant))
      found.push_back({{measure, needed},
                       fmt::format("needs {}", needed.names.front()),
                       fmt::format("add it, or use {} = \"none\"", measure.names.front())});
    if (!is_needed && given.*constant)
      found.push_back({{needed, measure},
                       "without effect with this fatigue_measure",
                       is_none ? "set fatigue_measure, or omit it" : "omit it"});
  }
  if (has_mean && given.fatigue_limit && given.ultimate_strength &&
      *given.fatigue_limit >= *given.ultimate_strength)
    found.push_back({{key(&Constants::fatigue_limit), key(&Constants::ultimate_strength)},
                     "the amplitude that the material endures must be less than its ultimate_strength",
                     "use a smaller fatigue_limit or more ultimate_strength"});
  if (is_none && given.fatigue_exponent)
    found.push_back({{key(&Constants::fatigue_exponent), measure},
                     "without effect without a fatigue_measure",
                     "set fatigue_measure, or omit it"});
}

/// Displacement elements of an orthotropic material are not mixed with a pressure.
void check_locking(const Case& c, const PlacedMaterial& placed, Conflicts& found) {
  const double least = placed.least_compliance();
  const CaseKeys keys{placed.poissons_ratio_key(),
                      key_of_constant(placed.layer, &OrthotropicConstants::poissons_ratio_radial_axial),
                      key_of_constant(placed.layer, &OrthotropicConstants::poissons_ratio_azimuthal_axial),
                      key_of(&Grid::degree), key_of(&Material::plane)};
  const auto refuse = [&](std::string problem, std::string remedy) {
    found.push_back({keys, std::move(problem), std::move(remedy)});
  };
  if (placed.orthotropic()->locks())
    refuse(
        "so near the end of their range that elements would lock, like those of an isotropic material with "
        "nu > 0.485",
        "use smaller ratios; only isotropic materials may be nearly incompressible");
  else if (c.grid.degree == 1 && least < 0.2)
    refuse(
        "so large that elements of degree 1 are too stiff, like those of an isotropic material with nu > 0.4",
        "use degree = 2, or smaller ratios");
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

/// What lies between two radii of layers or cords needs a row.
void check_rows(const Case& c, Conflicts& found) {
  const int least = static_cast<int>(radii_of_lines(c).size()) + 1;
  if (c.grid.radial_cells >= least) return;
  CaseKeys keys{key_of(&Grid::radial_cells)};
  if (!c.layers.empty()) keys.push_back(table_of<MaterialLayer>(0));
  if (!c.cords.empty()) keys.push_back(table_of<MaterialCord>(0));
  found.push_back({std::move(keys), fmt::format("layers and cords divide the ring into {} parts", least),
                   fmt::format("use at least {} rows", least)});
}

/// A stiff layer moves almost as a rigid body between soft ones: in its equations the forces of its
/// neighbours are smaller than its own by the contrast, which costs as many digits.
void check_contrast(const Case& c, Conflicts& found) {
  constexpr double largest = 1e9;
  const auto ring = placed_materials(c);
  const auto modulus = [](const PlacedMaterial& placed) { return placed.youngs_modulus(); };
  const PlacedMaterial &softest = *std::ranges::min_element(ring, {}, modulus),
                       &stiffest = *std::ranges::max_element(ring, {}, modulus);
  const double ratio = modulus(stiffest) / modulus(softest);
  if (ratio <= largest) return;
  found.push_back({{stiffest.youngs_modulus_key(), softest.youngs_modulus_key()},
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

/// Cords lie in material without holes, below the condensed rows at the tread.
void check_cords(const Case& c, Conflicts& found) {
  const PolarGrid<2> grid = polar_grid<2>(c);
  const double rim = c.wheel.inner_radius, tread = c.wheel.outer_radius, rounding = 1e-9 * tread;
  const int highest = grid.cells[0] - tread_rows(c);
  const Bands solid = bands(c);
  std::vector<SolidAnnulus> annuli = solid.between;
  annuli.push_back({rim, rim + solid.rim.thickness});
  annuli.push_back({tread - solid.tread.thickness, tread});
  for (std::size_t i = 0; i < c.cords.size(); ++i) {
    const double radius = c.cords[i].radius;
    const int line = grid.nearest_line(radius).line;
    if (radius <= rim + rounding || line > highest) {
      found.push_back(
          {{key_of(&MaterialCord::radius, i), key_of(&Grid::radial_cells), key_of(&Wheel::inner_radius),
            key_of(&Wheel::outer_radius)},
           "cords lie between the rim and the rows of cells at the tread, which are condensed",
           fmt::format("use more than {:.6g} m and less than {:.6g} m", rim, grid.radius(highest))});
    } else if (std::ranges::none_of(annuli, [&](const SolidAnnulus& annulus) {
                 return grid.radius(line - 1) > annulus.inner - rounding && radius < annulus.outer + rounding;
               })) {
      found.push_back(
          {{key_of(&MaterialCord::radius, i), key_of(&Optimizer::rim_band), key_of(&Optimizer::tread_band),
            table_of<MaterialCord>(i)},
           fmt::format("holes may reach the cords: the row of cells below {:.6g} m is in no layer "
                       "with holes = \"none\" and in no band at rim or tread",
                       radius),
           "put the cords into such a layer or band"});
    }
  }
}

/// The condensed rows at the tread, of which there are several with an annulus, must be of one material.
void check_material_of_annulus(const Case& c, Conflicts& found) {
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

}  // namespace

void material_conflicts(const Case& c, Conflicts& found) {
  check_names(c, found);
  if (c.wheel.inner_radius >= c.wheel.outer_radius || !check_places(c, found)) return;
  std::set<std::optional<std::size_t>> seen;
  for (const PlacedMaterial& placed : placed_materials(c)) {
    if (!seen.insert(placed.layer).second) continue;
    if (placed.isotropic())
      check_compressibility(c, *placed.isotropic(), placed.poissons_ratio_key(), found);
    else if (check_constants(c, placed.layer, found))
      check_locking(c, placed, found);
    check_fatigue(c, placed, found);
  }
  check_rows(c, found);
  design_radius_conflicts(c, found);
  check_cords(c, found);
  check_material_of_annulus(c, found);
  check_named_layers(c, found);
  check_contrast(c, found);
}

}  // namespace wheelwright
