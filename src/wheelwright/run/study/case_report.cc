#include "wheelwright/run/study/case_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/overload.h"
#include "wheelwright/case/shape_symmetry.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/single_load.h"
#include "wheelwright/mechanics/rolling/contact_failure.h"
#include "wheelwright/run/study/parting_planes.h"
#include "wheelwright/run/study/problem_size.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/annulus.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {

namespace {

std::string line(std::string_view name, std::string_view value) {
  return fmt::format("  {:<22}{}\n", name, value);
}

std::string load_report(const Case& c) {
  const std::string load = c.load.travel
                               ? line("rim travel", fmt::format("{:.6g} mm", *c.load.travel * 1e3))
                               : line("load", fmt::format("{:.6g} N on {:.6g} m = {:.6g} N/m", c.load.force,
                                                          c.wheel.width, load_per_metre(c)));
  const std::string speed = c.load.speed > 0 ? line("speed", fmt::format("{:.6g} m/s", c.load.speed)) : "";
  const std::string ground =
      c.load.ground == "flat" ? "" : line("ground", fmt::format("{}", ground_text(c.load)));
  return load + speed + ground +
         line("load positions",
              fmt::format("{} per sector, {} around the wheel", c.load.positions, total_load_positions(c)));
}

std::string constants_text(const PlacedMaterial& placed) {
  if (const Material* m = placed.isotropic())
    return fmt::format("E {:.6g} MPa, nu {:.6g}", m->youngs_modulus / 1e6, m->poissons_ratio);
  const OrthotropicMaterial& m = *placed.orthotropic();
  return fmt::format("E radial {:.6g}, azimuthal {:.6g}, axial {:.6g} MPa", m.modulus_r / 1e6,
                     m.modulus_t / 1e6, m.modulus_z / 1e6);
}

/// One line a layer, from the rim to the tread.
std::string layers_report(const Case& c) {
  std::string report;
  for (const PlacedMaterial& placed : placed_materials(c)) {
    const auto& layer = placed.layer;
    report += line(placed.name,
                   fmt::format("radius {:.6g} to {:.6g} mm, {}, {}{}", placed.inner_radius * 1e3,
                               placed.outer_radius * 1e3, constants_text(placed),
                               placed.density() ? fmt::format("{:.6g} kg/m^3", *placed.density())
                                                : "no density, so no mass is shown",
                               layer && c.layers[*layer].holes == LayerHoles::none ? ", no holes" : ""));
  }
  for (const DesignRadius& one : design_radii(c))
    report += line("chosen", fmt::format("{} from {:.6g} to {:.6g} mm, now {:.6g} mm", one.name,
                                         one.least * 1e3, one.most * 1e3, one.radius * 1e3));
  return report;
}

/// Shows the wheel and its material, also where they are defaults.
std::string wheel_report(const Case& c) {
  const std::string radii =
      fmt::format("radius {:.6g} to {:.6g} mm, width {:.6g} mm", c.wheel.inner_radius * 1e3,
                  c.wheel.outer_radius * 1e3, c.wheel.width * 1e3);
  if (!c.layers.empty() || tread_material(c).orthotropic()) return line("wheel", radii);
  const std::string plane = c.wheel.dimension == 3              ? "three dimensions"
                            : c.material.plane == Plane::strain ? "plane strain"
                                                                : "plane stress";
  return line("wheel", radii) +
         line("material",
              fmt::format("E {:.6g} MPa, nu {:.6g}, {}, {} strains", c.material.youngs_modulus / 1e6,
                          c.material.poissons_ratio, plane, has_large_strains(c) ? "large" : "small"));
}

std::string material_report(const Case& c) {
  if (!c.layers.empty() || tread_material(c).orthotropic())
    return layers_report(c) +
           line("E* of the contact", fmt::format("about {:.3g} MPa", effective_contact_modulus(c) / 1e6));
  return line("lambda", fmt::format("{:.6g} MPa", c.material.lambda() / 1e6)) +
         line("mu", fmt::format("{:.6g} MPa", c.material.mu() / 1e6)) +
         line("E* of the contact", fmt::format("{:.6g} MPa", c.material.contact_modulus() / 1e6));
}

/// How the tread is refined, and estimates for a given load.
std::string contact_report(const Case& c) {
  std::string levels = line(
      "tread levels", fmt::format("{} in a run, {} in results", tread_levels(c), tread_levels_of_results(c)));
  if (c.load.travel || c.contact.with == Counterpart::ring) return levels;
  const double radius = contact_radius(c);
  const std::string on_ground =
      radius == c.wheel.outer_radius ? "" : line("Hertz radius", fmt::format("{:.4g} mm", radius * 1e3));
  return levels + on_ground + line("Hertz half-width", fmt::format("{:.4g} mm", hertz_half_width(c) * 1e3)) +
         line("Hertz peak pressure", fmt::format("{:.4g} MPa", hertz_peak_pressure(c) / 1e6)) +
         line("cells in the contact",
              fmt::format("{:.1f} of {:.4g} mm", cells_per_contact_patch(c), tread_cell_width(c) * 1e3));
}

/// E.g. "1.9 %", "94 %", "150 %".
std::string rounded_percents(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

bool depends_on_frequency(const Case& c) {
  return std::ranges::any_of(placed_materials(c), [](const PlacedMaterial& placed) {
    return placed.loss_factor() && !placed.loss_factor()->table().empty();
  });
}

/// How well the load positions resolve the rolling resistance, and at which frequencies the material is
/// strained if its losses depend on them.
std::string losses_report(const Case& c) {
  if (!has_loss_factor(c)) return "";
  std::string frequencies;
  if (depends_on_frequency(c)) {
    const auto [turn, contact, last] = strain_frequencies(c);
    frequencies = line("strain frequencies",
                       fmt::format("{:.3g} Hz (turn) to {:.3g} Hz (load positions), near the contact mostly "
                                   "below {:.3g} Hz",
                                   turn, last, contact));
  }
  return line("rolling resistance",
              fmt::format("load positions {:.3g} mm apart at the tread leave out about {} of it",
                          2 * std::numbers::pi * c.wheel.outer_radius / total_load_positions(c) * 1e3,
                          rounded_percents(unresolved_losses(c)))) +
         frequencies;
}

/// What a run does before its first shape.
std::string parting_report(const Case& c) {
  if (!finds_parting_plane(c)) return "";
  const int n = c.grid.axial_cells + 1;
  return line("parting plane",
              fmt::format("found by a run among {} planes, in about {:.2g} s; until then at the default", n,
                          n * estimated_seconds_in_3d(problem_size(c))));
}

std::string time_report(const Case& c) {
  return line("time", fmt::format("about {:.2g} s for one shape on one core",
                                  estimated_seconds_in_3d(problem_size(c)))) +
         line("with grooves", fmt::format("at most about {:.0f} MB and {:.2g} s, once edges cross all faces "
                                          "between sectors",
                                          std::ceil(estimated_memory(problem_size_of_grooves(c)) / 1e6),
                                          estimated_seconds_in_3d(problem_size_of_grooves(c))));
}

std::string time_at_large_deformation(const Case& c) {
  return line("time",
              fmt::format("about {:.2g} s for one shape on one core, at large deformation; the first "
                          "one takes twice as long, and those near their largest load up to ten times",
                          estimated_seconds_at_large_deformation(problem_size(c))));
}

std::string drawing_report(const Case& c) {
  std::string report;
  for (const auto& [key, text] : drawing_repetitions(c)) report += line(key, text);
  return report;
}

/// The heights of the rows, if they differ.
std::string rows_report(const Case& c) {
  const PolarGrid<2> grid = polar_grid<2>(c);
  if (grid.fixed_lines.empty()) return "";
  std::vector<std::string> parts;
  for (const EqualRows& rows : grid.all_equal_rows())
    parts.push_back(fmt::format("{} of {:.4g} mm", rows.count(), 1e3 * rows.height()));
  return line("rows", fmt::format("{}, from the rim to the tread", fmt::join(parts, ", ")));
}

std::string size_report(const Case& c) {
  const std::string along_axle = c.wheel.dimension == 3 ? fmt::format(" x {}", c.grid.axial_cells) : "";
  return drawing_report(c) + rows_report(c) +
         line("sector", fmt::format("1 of {}, {:.6g} deg, {} x {}{} cells", c.wheel.sectors,
                                    sector_angle(c) * 180 / std::numbers::pi, c.grid.radial_cells,
                                    c.grid.angular_cells / c.wheel.sectors, along_axle)) +
         line("unknowns", fmt::format("at most {}, {} of them per sector", dof_bound(c),
                                      dof_bound(c) / c.wheel.sectors)) +
         line("memory", fmt::format("about {:.0f} MB", std::ceil(estimated_memory(problem_size(c)) / 1e6))) +
         (has_large_strains(c)     ? time_at_large_deformation(c)
          : c.wheel.dimension == 3 ? time_report(c) + parting_report(c)
                                   : "");
}

/// Lengths given in millimetres yield a wheel of hundreds of metres.
std::vector<std::string> doubtful_lengths(const Case& c) {
  constexpr double largest_radius = 10, widest = 10;  // [m], and in outer radii
  const auto doubt = [](const char* key, double value) {
    return fmt::format("{} = {} m: lengths are in metres; if that is in mm, write {}", key,
                       number_text(value), number_text(value / 1000));
  };
  std::vector<std::string> result;
  if (c.wheel.outer_radius > largest_radius)
    result.push_back(doubt("wheel.outer_radius", c.wheel.outer_radius));
  if (c.wheel.width > std::max(largest_radius, widest * c.wheel.outer_radius))
    result.push_back(doubt("wheel.width", c.wheel.width));
  return result;
}

/// Moduli given in megapascals yield a wheel of jelly.
std::vector<std::string> doubtful_modulus(const Case& c) {
  std::vector<std::string> result;
  for (const PlacedMaterial& placed : placed_materials(c))
    if (const double modulus = placed.youngs_modulus(); may_be_in_megapascals(modulus))
      result.push_back(fmt::format("{} = {} Pa: {}", placed.youngs_modulus_key().path(), number_text(modulus),
                                   question_of_megapascals(modulus)));
  return result;
}

/// Explains the effect of a patch of too few cells, and what would help. Below the grid scale the contact is
/// a line load on a cell, whose indentation contains the logarithm of the cell's width instead of the
/// patch's. The errors are those of rings whose solution is known (docs/method.md).
std::string coarse_contact_warning(const Case& c, double cells) {
  Case finest = c;
  finest.grid.tread_levels.reset();
  finest = with_levels_of_results(finest);
  const double reachable = cells_per_contact_patch(finest);
  std::string text = fmt::format("the contact patch is only {:.2g} cells wide: ", cells);
  if (cells < 1)
    text += fmt::format(
        "pressures are not resolved, and the travel and the strain energy lack part of the local "
        "indentation, about {:.2g} mm",
        -std::log(cells) * 2 * load_per_metre(c) / (std::numbers::pi * effective_contact_modulus(c)) * 1e3);
  else
    text += cells < 2 ? "peak pressures may be off by a third, travel and energies by 3 %"
                      : "peak pressures may be off by a tenth, travel and energies by 1.5 %";
  if (reachable >= least_cells_per_contact_patch)
    return text + fmt::format("; with grid.tread_levels = {} it is {:.1f} cells wide",
                              *finest.grid.tread_levels, reachable);
  return text + fmt::format("; grid.angular_cells >= {:.0f} would resolve it",
                            std::ceil(c.grid.angular_cells * least_cells_per_contact_patch / reachable));
}

/// Holes of the initial shape across layers that have none end at them.
std::vector<std::string> holes_in_solid_layers(const Case& c) {
  std::vector<std::string> result;
  if (c.wheel.dimension == 3 || c.layers.empty()) return result;
  Case open = c;
  for (MaterialLayer& layer : open.layers) layer.holes = LayerHoles::allowed;
  const LevelSet<2> shape = initial_shape<2>(open);
  const PolarGrid<2>& grid = shape.lattice.grid();
  for (const auto& [name, inner, outer, material, layer, large] : placed_materials(c)) {
    if (!layer || c.layers[*layer].holes == LayerHoles::allowed) continue;
    const auto part = in_rows(shape, grid.nearest_line(inner).line, grid.nearest_line(outer).line);
    if (material_measure(part) < (1 - 1e-3) * sector_measure<2>(part.lattice.grid()))
      result.push_back(
          fmt::format("holes reach into {}, which has holes = \"none\": there they stay material, and "
                      "become smaller, vanish or are divided",
                      name));
  }
  return result;
}

/// Rows beside others that are several times as high. Names the layer that ends or begins there, and the
/// number of rows nearest to the case's with which they are not.
std::vector<std::string> unequal_rows(const Case& c) {
  constexpr double most = 3;
  const auto [ratio, radius] = largest_row_ratio(polar_grid<2>(c));
  if (ratio <= most) return {};
  std::string name = c.cords.empty() ? "the annulus" : "cords", remedy;
  for (std::size_t i = 0; i < c.layers.size(); ++i)
    if (const auto [inner, outer] = radii(c, c.layers[i]);
        std::min(std::abs(inner - radius), std::abs(outer - radius)) < 2e-9 * c.wheel.outer_radius)
      name = name_of_layer(c, i);
  Case finer = c;
  const int usual = c.grid.radial_cells, step = 1 << c.optimizer.coarse_levels;
  while (remedy.empty() && (finer.grid.radial_cells += step) <= 8 * usual)
    if (largest_row_ratio(polar_grid<2>(finer)).ratio <= most)
      remedy = fmt::format("; with grid.radial_cells = {} it is at most {:g} times as high",
                           finer.grid.radial_cells, most);
  return {fmt::format("at {}, radius {:.6g} m, a row of cells is {:.2g} times as high as the next one{}",
                      name, radius, ratio, remedy)};
}

/// Loss factors that are not known where the material is mostly strained.
std::vector<std::string> unknown_frequencies(const Case& c) {
  std::vector<std::string> result;
  for (const Case& single : single_load_cases(c))
    for (const PlacedMaterial& placed : placed_materials(c)) {
      const auto& factor = placed.loss_factor();
      const auto& table = factor->table();
      const StrainFrequencies strained = strain_frequencies(single);
      if (table.empty() || single.load.speed == 0 ||
          (strained.turn >= table.front()[0] && strained.contact <= table.back()[0]))
        continue;
      result.push_back(fmt::format(
          "{} is given from {} to {} Hz, and the wheel is strained from {:.3g} to {:.3g} Hz at {} m/s: "
          "beyond "
          "its ends the loss factor is taken as constant",
          placed.loss_factor_key().path(), number_text(table.front()[0]), number_text(table.back()[0]),
          strained.turn, strained.contact, number_text(single.load.speed)));
    }
  return result;
}

/// Where the numbers of the losses would be poor.
std::vector<std::string> warnings_of_losses(const Case& c) {
  constexpr double much = 0.05, little = 0.01, large_factor = 0.3;
  std::vector<std::string> result;
  if (!has_loss_factor(c)) return result;
  const Case worst = std::ranges::max(single_load_cases(c), {}, unresolved_losses);
  if (const double share = unresolved_losses(worst); share > much)
    result.push_back(fmt::format(
        "with {} = {} about {} of the rolling resistance is left out, near the contact, which is about "
        "{:.3g} mm long; with {} it is {:g} %, also by wheelwright analyze --positions {}",
        key_of(&Load::positions).path(), c.load.positions, rounded_percents(share),
        2e3 * likely_half_width(worst), positions_for_losses(worst, little), 100 * little,
        positions_for_losses(worst, little)));
  for (const PlacedMaterial& placed : placed_materials(c))
    if (placed.loss_factor()->largest() > large_factor)
      result.push_back(fmt::format(
          "{} has the loss factor {}: the rolling resistance is of first order in it, and a rough estimate "
          "above {:g}",
          placed.name, number_text(placed.loss_factor()->largest()), large_factor));
  std::ranges::move(unknown_frequencies(c), std::back_inserter(result));
  return result;
}

/// A constant of heat that the case gives.
std::optional<CaseKey> constant_of_heat(const Case& c) {
  if (c.material.conductivity) return key_of(&Material::conductivity);
  if (c.material.maximum_temperature) return key_of(&Material::maximum_temperature);
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    if (c.layers[i].conductivity) return key_of(&MaterialLayer::conductivity, i);
    if (c.layers[i].maximum_temperature) return key_of(&MaterialLayer::maximum_temperature, i);
  }
  return {};
}

/// Constants of heat without a section that says what takes the heat.
std::vector<std::string> unused_constants_of_heat(const Case& c) {
  const auto key = constant_of_heat(c);
  if (!key || c.heat != Heat()) return {};
  return {
      fmt::format("{} has no effect: no temperature is computed, because nothing says what takes the heat; "
                  "add a section [heat] "
                  "with a convection or a rim_temperature",
                  key->path())};
}

/// Where the temperature of a plane wheel is not constant over the width: with a uniform source and no other
/// way out than its side faces, the middle rises by h w / (4 k) of the rise of the faces more.
std::vector<std::string> warnings_of_heat(const Case& c) {
  constexpr double much = 0.1;
  const auto cooled = cooling(c);
  if (!cooled || !has_conductivity(c) || c.wheel.dimension == 3) return {};
  const auto materials = placed_materials(c);
  const double least = *std::ranges::min(materials, {},
                                         [](const auto&placed) { return placed.conductivity().value_or(0); })
                            .conductivity(),
               more = cooled->side_faces * c.wheel.width / (4 * least);
  if (!(more > much)) return {};
  return {fmt::format(
      "temperatures in 2D are constant over the width, and the side faces take heat from all of it: in the "
      "middle of the width the temperature may rise by up to {} more than shown; use wheel.dimension = "
      "3, or heat.side_convection = 0 for a bound",
      rounded_percents(more))};
}

/// Where load positions would miss the largest stress of a turn.
std::vector<std::string> warnings_of_fatigue(const Case& c) {
  if (!has_fatigue_limit(c)) return {};
  const Case narrowest = std::ranges::min(single_load_cases(c), {}, likely_half_width);
  const double half_width = likely_half_width(narrowest),
               step = 2 * std::numbers::pi * c.wheel.outer_radius / total_load_positions(c);
  if (step <= half_width) return {};
  return {fmt::format(
      "fatigue near the contact: {} = {} are {:.3g} mm apart at the tread and pass over the largest stress "
      "of "
      "a turn, in a contact about {:.3g} mm long; {} see it (wheelwright analyze has the option --positions)",
      key_of(&Load::positions).path(), c.load.positions, step * 1e3, 2e3 * half_width,
      std::ceil(c.load.positions * step / half_width))};
}

std::string bounds_report(const Case& c) {
  std::string report;
  for (const Constraint& bound : c.constraints) {
    std::string text = name(quantity_of(c, bound));
    const char* separator = " ";
    for (const auto& [words, value] :
         {std::pair{"at least", bound.at_least}, {"at most", bound.at_most}, {"equal to", bound.equals}})
      if (value) {
        text += fmt::format("{}{} {}", separator, words, shown_text(bound.quantity, *value, c.wheel));
        separator = ", ";
      }
    if (bound.over == OverPositions::worst) text += " at the worst load position";
    if (bound.over == OverPositions::each) text += " at each load position";
    if (!bound.load_case.empty()) text += " in " + bound.load_case;
    report += line("bound", text);
  }
  return report;
}

/// From layer to layer, edges lean over by at most the length of a cell.
std::string overhang_limited_by_grid(const Case& c) {
  const auto asked = print(c);
  if (!asked) return "";
  const PolarGrid<3> grid = polar_grid<3>(c);
  const double slope = slope_on(grid, *asked);
  if (slope >= asked->slope) return "";
  constexpr double degrees_per_radian = 180 / std::numbers::pi;
  return fmt::format(
      "layers of cells {:.3g} mm high limit the overhang to {:.3g} deg instead of {:.3g} deg; with "
      "grid.axial_cells = {} they do not",
      1e3 * grid.axial_size(), std::atan(slope) * degrees_per_radian,
      std::atan(asked->slope) * degrees_per_radian,
      std::ceil(grid.width * asked->slope / longest_edge_across(grid) - 1e-9));
}

std::string load_case_text(const CaseLoad& load_case) {
  const auto& share = load_case.distance_share;
  return fmt::format("{}, weight {:.6g}{}", load_case.name, load_case.weight,
                     share ? fmt::format(", {:.6g} % of the distance", 100 * *share) : "");
}

}  // namespace

std::string derived_report(const Case& c) {
  if (c.load.cases.empty())
    return wheel_report(c) + load_report(c) + material_report(c) + contact_report(c) + losses_report(c) +
           size_report(c) + bounds_report(c);
  std::string report = wheel_report(c);
  Case finest = c;
  finest.grid.tread_levels = tread_levels(c);
  for (std::size_t k = 0; k < c.load.cases.size(); ++k) {
    const Case single = with_load_case(finest, static_cast<int>(k));
    report += line("load case", load_case_text(c.load.cases[k])) + load_report(single) +
              contact_report(single) + losses_report(single);
  }
  if (const std::string sum = sum_over_load_cases(c); !sum.empty())
    report += line("objective", minimizes_weighted_sum(c) ? sum : name(minimized_quantity(c)) + ", " + sum);
  return report + material_report(c) + size_report(c) + bounds_report(c);
}

std::string clearance_report(const cad::Clearances& clearances) {
  const auto width = [](const char* name, const std::optional<cad::Clearance>& clearance) {
    return clearance ? line(name, fmt::format("{:.4g} mm", clearance->width * 1e3)) : std::string();
  };
  return width("thinnest wall", clearances.wall) + width("narrowest gap", clearances.gap);
}

std::vector<std::string> warnings(const Case& c) {
  std::vector<std::string> result = doubtful_lengths(c);
  std::ranges::move(asymmetry_warnings(c), std::back_inserter(result));
  std::ranges::move(doubtful_modulus(c), std::back_inserter(result));
  Case run = c;
  run.grid.tread_levels = tread_levels(c);
  const Case narrowest = std::ranges::min(single_load_cases(run), {}, cells_per_contact_patch);
  if (const double cells = cells_per_contact_patch(narrowest); cells < least_cells_per_contact_patch)
    result.push_back(coarse_contact_warning(narrowest, cells));
  for (const Case& single : single_load_cases(run))
    if (const double a = hertz_half_width(single);
        !single.load.travel && single.load.ground == "internal_drum" && a > 0.3 * c.wheel.outer_radius) {
      result.push_back(fmt::format(
          "inside the drum the contact would be {:.2g} times as wide as the wheel's radius: Hertz's "
          "theory does not hold for it, and linear theory neglects how its ends turn",
          2 * a / c.wheel.outer_radius));
      break;
    }
  if (wants_uniformity(c) && c.grid.angular_cells % total_load_positions(c) != 0)
    result.push_back(fmt::format(
        "load positions between columns of cells use different points of the tread, which affects the "
        "uniformity functionals; with grid.angular_cells a multiple of sectors * positions = {} they do not",
        total_load_positions(c)));
  if (!has_holes(c) && c.optimizer.nucleation == NucleationTime::never && design_radii(c).empty())
    result.push_back("there are no holes, so no boundary can move");
  std::ranges::copy(holes_in_solid_layers(c), std::back_inserter(result));
  if (const std::string limited = overhang_limited_by_grid(c); !limited.empty()) result.push_back(limited);
  std::ranges::copy(unequal_rows(c), std::back_inserter(result));
  std::ranges::copy(warnings_of_losses(c), std::back_inserter(result));
  std::ranges::copy(warnings_of_fatigue(c), std::back_inserter(result));
  std::ranges::copy(unused_constants_of_heat(c), std::back_inserter(result));
  std::ranges::copy(warnings_of_heat(c), std::back_inserter(result));
  if (const double cells = smallest_hole_in_cells(c);
      cells < least_cells_per_hole && c.optimizer.smoothing == 0)
    result.push_back(
        fmt::format("the smallest hole is {:.1f} cells wide: its edge may fray into fingers one cell wide; "
                    "optimizer.smoothing = 0.1 or a finer grid prevents this",
                    cells));
  if (c.ghost_penalty.kind == GhostPenaltyKind::paper && c.grid.degree == 2)
    result.push_back(
        "ghost_penalty.kind = \"paper\" does not keep the stiffness well conditioned for degree 2: some "
        "shapes will "
        "fail; \"full\" is safe");
  for (const PlacedMaterial& placed : placed_materials(c))
    if (const Material* material = placed.isotropic();
        c.grid.degree == 1 && material && material->plane_strain_equivalent().poissons_ratio > 0.4)
      result.push_back(fmt::format(
          "grid.degree = 1 is too stiff for {} = {}: at 0.48 and 28 x 384 cells "
          "travel and energy are 5 % too small and pressures useless; grid.degree = 2 is accurate",
          placed.poissons_ratio_key().path(), material->poissons_ratio));
  if (c.contact.method == ContactMethod::nitsche && c.contact.gamma_0 > largest_smooth_gamma_0)
    result.push_back(
        fmt::format("contact.gamma_0 = {} is so large that pressures may oscillate by a third; "
                    "contact.theta = -1 and 0 need at most {:g}",
                    c.contact.gamma_0, enough_gamma_0));
  if (c.ghost_penalty.xi == 0)
    result.push_back("ghost_penalty.xi = 0: slivers in cut cells will spoil the solution");
  if (c.optimizer.velocity == VelocityKind::harmonic && c.optimizer.smoothing == 0)
    result.push_back(
        "optimizer.velocity = \"harmonic\" without optimizer.smoothing lets fingers one cell wide "
        "grow; smoothing = 0.3 with smooth_every = 1, or velocity = \"h1\", prevents this");
  if (c.volume.control == VolumeControl::paper)
    result.push_back("volume.control = \"paper\" lets the volume drift; \"exact\" keeps it fixed");
  return result;
}

}  // namespace wheelwright
