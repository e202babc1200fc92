#include "wheelwright/case/derived.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/load_values.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {

using std::numbers::pi;

Case with_load_case(Case c, int load_case) {
  c.load = with_changes(c.load, c.load.cases[load_case]);
  c.load.cases.clear();
  return c;
}

std::vector<Case> single_load_cases(const Case& c) {
  if (c.load.cases.empty()) return {c};
  std::vector<Case> cases;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    cases.push_back(with_load_case(c, static_cast<int>(k)));
  return cases;
}

std::vector<int> load_cases_of(const Case& c, const Constraint& constraint) {
  if (c.load.cases.empty()) return {0};
  std::vector<int> result;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    if (constraint.load_case.empty() || constraint.load_case == c.load.cases[k].name)
      result.push_back(static_cast<int>(k));
  return result;
}

int load_case_of(const Case& c, const Expectation& expectation) {
  const auto found = std::ranges::find(c.load.cases, expectation.load_case, &CaseLoad::name);
  return found == c.load.cases.end() ? 0 : static_cast<int>(found - c.load.cases.begin());
}

double load_per_metre(const Case& c) { return c.load.force / c.wheel.width; }

double contact_radius(const Case& c) {
  constexpr double least = 0.2;  // on edges
  const Ground ground = ground_of(c.load);
  const double radius = effective_radius(ground, c.wheel.outer_radius);
  return ground.is_even() ? radius : std::max(radius, least * c.wheel.outer_radius);
}

namespace {

double hertz_half_width(const Case& c, double modulus) {
  return 2 * std::sqrt(load_per_metre(c) * contact_radius(c) / (pi * modulus));
}

}  // namespace

double effective_contact_modulus(const Case& c) {
  double modulus = tread_material(c).contact_modulus();
  if (c.layers.empty()) return modulus;
  for (int pass = 0; pass < 50; ++pass) modulus = contact_modulus(c, hertz_half_width(c, modulus));
  return modulus;
}

double hertz_half_width(const Case& c) { return hertz_half_width(c, effective_contact_modulus(c)); }

double hertz_peak_pressure(const Case& c) { return 2 * load_per_metre(c) / (pi * hertz_half_width(c)); }

double likely_half_width(const Case& c) {
  if (c.contact.with == Counterpart::ring) return pi * c.wheel.outer_radius;
  // A travel d makes a patch of about sqrt(0.4 R_e d): the logarithm in the compliance of a roller is near 5.
  return c.load.travel ? std::sqrt(0.4 * contact_radius(c) * *c.load.travel) : hertz_half_width(c);
}

namespace {

/// The smallest number of halvings that gives so many cells per patch, within so many points per column; in
/// 3D as many per line around the wheel, and not more than 40, because there are many lines.
int levels_for(const Case& c, double cells_per_patch, int most_points) {
  if (has_large_strains(c)) return 0;  // it does not refine the tread
  if (c.wheel.dimension == 3) most_points = std::min(most_points, 40);
  const double cell = 2 * pi * c.wheel.outer_radius / c.grid.angular_cells;
  int levels = 0;
  while (2 * likely_half_width(c) * (1 << levels) < cells_per_patch * cell &&
         c.contact.quadrature_points * (2 << levels) <= most_points)
    ++levels;
  return levels;
}

/// As many as needed by the load case with the narrowest contact. Radii that are chosen with the shape do not
/// change them.
int most_levels_for(const Case& c, double cells_per_patch, int most_points) {
  int levels = 0;
  for (const Case& single : single_load_cases(at_middle_radii(c)))
    levels = std::max(levels, levels_for(single, cells_per_patch, most_points));
  return levels;
}

}  // namespace

OptimizerMethod optimizer_method(const Case& c) {
  if (c.optimizer.method != OptimizerMethod::automatic) return c.optimizer.method;
  const bool needs_descent =
      c.volume.control == VolumeControl::paper || c.optimizer.velocity == VelocityKind::harmonic;
  return needs_descent ? OptimizerMethod::descent : OptimizerMethod::sequential_quadratic;
}

double convergence_tolerance(const Case& c) {
  const bool descends = optimizer_method(c) == OptimizerMethod::descent;
  return c.optimizer.tolerance.value_or(descends ? 1e-5 : 2e-4);
}

VelocityKind velocity_kind(const Case& c) {
  if (c.optimizer.velocity != VelocityKind::automatic) return c.optimizer.velocity;
  const bool is_plane = c.wheel.dimension == 2,
             is_sum_alone = minimizes_weighted_sum(c) && c.constraints.empty();
  const bool is_vector =
      is_plane && is_sum_alone && optimizer_method(c) == OptimizerMethod::sequential_quadratic;
  return is_vector ? VelocityKind::vector : VelocityKind::h1;
}

double velocity_length(const Case& c) {
  const bool is_vector = velocity_kind(c) == VelocityKind::vector;
  return c.optimizer.velocity_length.value_or(is_vector ? std::min(8.0, 0.3 * c.grid.radial_cells) : 2);
}

int level_set_degree(const Case& c) { return c.grid.level_set_degree.value_or(2); }

int tread_levels(const Case& c) { return c.grid.tread_levels.value_or(most_levels_for(c, 8, 80)); }

int tread_levels_of_results(const Case& c) {
  return c.grid.tread_levels.value_or(most_levels_for(c, 36, 160));
}

Case with_levels_of_results(Case c) {
  c.grid.tread_levels = tread_levels_of_results(c);
  return c;
}

double tread_cell_width(const Case& c) {
  return 2 * pi * c.wheel.outer_radius / c.grid.angular_cells / (1 << tread_levels(c));
}

double smallest_hole_in_cells(const Case& c) {
  const double radial = largest_row_height(polar_grid<2>(c)),
               azimuthal = pi * (c.wheel.outer_radius + c.wheel.inner_radius) / c.grid.angular_cells;
  double smallest = smallest_hole_width(c);
  for (const HoleSphere& sphere : c.holes.spheres) smallest = std::min(smallest, 2 * sphere.radius);
  for (const HoleGroove& groove : c.holes.grooves)
    smallest = std::min({smallest, 2 * largest_depth(groove), groove.outer_radius - groove.inner_radius});
  const auto add = [&](Fill as, double diameter) {
    if (as == Fill::hole) smallest = std::min(smallest, diameter);
  };
  for (const CircleShape& circle : c.shapes.circles) add(circle.as, 2 * circle.radius);
  for (const EllipseShape& ellipse : c.shapes.ellipses)
    add(ellipse.as, std::min(ellipse.length, ellipse.width));
  for (const SlotShape& slot : c.shapes.slots) add(slot.as, slot.width);
  return smallest / std::max(radial, azimuthal);
}

namespace {

/// N a / (2 R_e) of the harmonic N / 2.
double resolved_harmonic(const Case& c) {
  return 0.5 * total_load_positions(c) * likely_half_width(c) / c.wheel.outer_radius;
}

}  // namespace

double unresolved_losses(const Case& c) {
  const double x = resolved_harmonic(c);
  return std::min(1.0, 3 / (8 * x * x));
}

StrainFrequencies strain_frequencies(const Case& c) {
  const double turn = c.load.speed / (2 * pi * c.wheel.outer_radius);
  return {turn, c.load.speed / (4 * likely_half_width(c)), turn * (total_load_positions(c) / 2)};
}

int positions_for_losses(const Case& c, double share) {
  const double x = std::sqrt(3 / (8 * share));
  return static_cast<int>(std::ceil(c.load.positions * x / resolved_harmonic(c)));
}

double cells_per_contact_patch(const Case& c) { return 2 * likely_half_width(c) / tread_cell_width(c); }

double sector_angle(const Case& c) { return 2 * pi / c.wheel.sectors; }

int total_load_positions(const Case& c) { return c.wheel.sectors * c.load.positions; }

namespace {
template <int dim>
PolarGrid<dim> grid_of_equal_rows(const Case& c) {
  PolarGrid<dim> grid{c.wheel.inner_radius, c.wheel.outer_radius, c.wheel.width, c.wheel.sectors,
                      std::array<int, dim>{}};
  grid.cells[0] = c.grid.radial_cells;
  grid.cells[1] = c.grid.angular_cells / c.wheel.sectors;
  if constexpr (dim == 3) grid.cells[2] = c.grid.axial_cells;
  return grid;
}

template <int dim>
PolarGrid<dim> grid_with_lines_at(const Case& c, const std::vector<double>& radii) {
  const auto grid = grid_of_equal_rows<dim>(c);
  return static_cast<int>(radii.size()) < c.grid.radial_cells ? with_lines_at(grid, radii) : grid;
}

/// The height of the row of cells at the tread. Radii that are chosen with the shape do not change it.
double tread_row(const Case& c) {
  return grid_with_lines_at<2>(c, radii_of_lines(at_middle_radii(c))).row_height(c.grid.radial_cells - 1);
}

/// The grid of a case with design radii: that of the middle of their ranges, whose lines move to the radii.
/// The rows that are condensed at the tread stay where they are.
template <int dim>
PolarGrid<dim> grid_with_design_lines(const Case& c) {
  const std::vector<double> middle = radii_of_lines(at_middle_radii(c)), radii = radii_of_lines(c);
  if (middle.size() != radii.size()) return grid_with_lines_at<dim>(c, radii);
  PolarGrid<dim> grid = grid_with_lines_at<dim>(c, middle);
  std::vector<FixedLine> fixed;
  for (std::size_t k = 0; k < radii.size(); ++k)
    fixed.push_back({grid.nearest_line(middle[k]).line, radii[k]});
  const int core_rows = grid.cells[0] - tread_rows(c);
  if (fixed.back().line < core_rows) fixed.push_back({core_rows, grid.radius(core_rows)});
  const auto is_beyond = [](const FixedLine& a, const FixedLine& b) { return a.radius >= b.radius; };
  if (std::ranges::adjacent_find(fixed, is_beyond) != fixed.end()) return grid_with_lines_at<dim>(c, radii);
  grid.fixed_lines = std::move(fixed);
  return grid;
}
}  // namespace

bool minimizes_weighted_sum(const Case& c) { return c.objective.minimize == Quantity(); }

namespace {

/// Whether quantities with this property are minimized, bounded or terms of the weighted sum.
bool optimizes_any(const Case& c, bool QuantityRow::*property) {
  const auto has_it = [&](const Quantity& quantity) { return (*quantity).*property; };
  const auto is_such_term = [&](const ObjectiveWeight& term) {
    return c.objective.*term.weight > 0 && has_it(built_in(term.quantity));
  };
  return has_it(c.objective.minimize) || std::ranges::any_of(c.constraints, has_it, &Constraint::quantity) ||
         std::ranges::any_of(c.objective.terms, has_it, &ObjectiveTerm::quantity) ||
         std::ranges::any_of(objective_weights, is_such_term);
}

}  // namespace

bool holds_volume(const Case& c) { return !optimizes_any(c, &QuantityRow::is_amount_of_material); }

bool optimizes_stresses(const Case& c) { return optimizes_any(c, &QuantityRow::integrates_stresses); }

bool optimizes_temperatures(const Case& c) { return optimizes_any(c, &QuantityRow::depends_on_heat); }

bool optimizes_edges(const Case& c) { return optimizes_any(c, &QuantityRow::has_kinks); }

bool wants_annulus(const Case& c) {
  return c.objective.annulus_matches_dual.has_value() || optimizes_any(c, &QuantityRow::observes_annulus);
}

bool wants_uniformity(const Case& c) {
  return c.objective.annulus_matches_dual.has_value() || optimizes_any(c, &QuantityRow::compares_with_mean);
}

double annulus_thickness(const Case& c) { return c.objective.annulus.value_or(tread_row(c)); }

double characteristic_length(const Case& c) { return c.objective.length.value_or(annulus_thickness(c)); }

int tread_rows(const Case& c) {
  if (!wants_annulus(c)) return 1;
  return std::max(1, static_cast<int>(std::lround(annulus_thickness(c) / tread_row(c))));
}

template <int dim>
PolarGrid<dim> polar_grid(const Case& c) {
  const auto radii = radii_of_lines(c);
  const bool has_design_lines =
      !radii.empty() && !design_radii(c).empty() && static_cast<int>(radii.size()) < c.grid.radial_cells;
  return has_design_lines ? grid_with_design_lines<dim>(c) : grid_with_lines_at<dim>(c, radii);
}
template decltype(polar_grid<2>) polar_grid<2>;
template decltype(polar_grid<3>) polar_grid<3>;

std::vector<SolidAnnulus> solid_layers(const Case& c) {
  std::vector<SolidAnnulus> result;
  for (const auto& [name, inner, outer, material, layer, large] : placed_materials(c)) {
    if (!layer || c.layers[*layer].holes == LayerHoles::allowed) continue;
    if (!result.empty() && inner <= result.back().outer)
      result.back().outer = outer;
    else
      result.push_back({inner, outer});
  }
  return result;
}

Bands bands(const Case& c) {
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius, usual = ring / 14;
  const double with_annulus = wants_annulus(c) ? annulus_thickness(c) + ring / 28 : 0;
  const double wall = c.optimizer.minimum_wall.value_or(0);
  Bands result{
      .rim = {c.optimizer.rim_band.value_or(std::max(usual, wall)), 1},
      .tread = {c.optimizer.tread_band.value_or(std::max({usual, with_annulus, wall})), tread_rows(c) + 1}};
  result.between = solid_layers(c);
  auto& between = result.between;
  const Wheel& w = c.wheel;
  while (!between.empty() && between.front().inner <= w.inner_radius + result.rim.thickness) {
    result.rim.thickness = std::max(result.rim.thickness, between.front().outer - w.inner_radius);
    between.erase(between.begin());
  }
  while (!between.empty() && between.back().outer >= w.outer_radius - result.tread.thickness) {
    result.tread.thickness = std::max(result.tread.thickness, w.outer_radius - between.back().inner);
    between.pop_back();
  }
  result.mould = mould(c);
  result.print = print(c);
  return result;
}

HoleRange free_region(const Case& c) {
  return in_dimension_of(c, [&](auto dim) { return hole_range(polar_grid<dim>(c), bands(c)); });
}

HoleRange room_for_holes(const Case& c) {
  const auto [inner, outer] = free_region(c);
  const double touch = in_dimension_of(c, [&](auto dim) { return 0.001 * polar_grid<dim>(c).resolution(); });
  return {inner - touch, outer + touch};
}

bool has_holes(const Case& c) {
  return c.holes != Holes{} || c.shapes != Shapes{} || !c.saved_shape.from.empty();
}

namespace {

/// Calls add(azimuth) for those of `count` evenly spaced holes that lie in one sector.
template <class Add>
void for_each_in_sector(const Case& c, int count, const std::optional<double>& phase, Add add) {
  const double spacing = 2 * pi / count, first = phase.value_or(spacing / 2);
  for (int i = 0; i < count / c.wheel.sectors; ++i) add(first + i * spacing);
}

}  // namespace

std::vector<Circle> sector_holes(const Case& c) {
  std::vector<Circle> holes;
  for (const NamedRing& named : named_rings(c))
    for_each_in_sector(c, named.ring.count, named.ring.phase, [&](double azimuth) {
      holes.push_back({named.ring.center_radius, azimuth, named.ring.radius});
    });
  return holes;
}

std::vector<Sphere> sector_spheres(const Case& c) {
  std::vector<Sphere> holes;
  for (const HoleSphere& sphere : c.holes.spheres)
    for_each_in_sector(c, sphere.count, sphere.phase, [&](double azimuth) {
      holes.push_back({sphere.center_radius, azimuth, sphere.z + 0.5 * c.wheel.width, sphere.radius});
    });
  return holes;
}

double largest_depth(const HoleGroove& groove) {
  return std::max(groove.depth, groove.outer_depth.value_or(groove.depth));
}

double largest_fillet(const HoleGroove& groove) {
  const double width = groove.outer_radius - groove.inner_radius;
  if (!groove.outer_depth) return std::min(groove.depth, 0.5 * width);
  const double slope = (*groove.outer_depth - groove.depth) / width, steep = std::hypot(1, slope);
  return std::min({groove.depth / (steep - slope), *groove.outer_depth / (steep + slope), 0.5 * width});
}

std::vector<Groove> grooves(const Case& c) {
  std::vector<Groove> result;
  for (const HoleGroove& groove : c.holes.grooves)
    for (const auto& [side, face] :
         {std::pair(GrooveSide::smaller_z, 0.0), std::pair(GrooveSide::larger_z, c.wheel.width)})
      if (groove.side == GrooveSide::both || groove.side == side)
        result.push_back({groove.inner_radius, groove.outer_radius, face, groove.depth,
                          groove.fillet.value_or(0.5 * largest_fillet(groove)), groove.outer_depth});
  return result;
}

Invariance invariance(const Case& c) {
  switch (c.optimizer.made) {
    case Manufacture::extruded:
      return Invariance::along_axle;
    case Manufacture::turned:
      return Invariance::about_axle;
    default:
      return Invariance::none;
  }
}

std::optional<Mould> mould(const Case& c) {
  const Optimizer& o = c.optimizer;
  if (o.made != Manufacture::moulded) return {};
  const double middle = c.grid.axial_cells / 2 * (c.wheel.width / c.grid.axial_cells);
  return Mould{o.parting_plane.value_or(middle), std::tan(o.draft)};
}

std::optional<Print> print(const Case& c) {
  constexpr double usual = std::numbers::pi / 4;
  const Optimizer& o = c.optimizer;
  if (o.made != Manufacture::printed) return {};
  return Print{o.stands_on, std::tan(o.overhang.value_or(usual))};
}

std::vector<TaperedHole> sector_tapered_holes(const Case& c) {
  std::vector<TaperedHole> holes;
  for (const HoleTapered& tapered : c.holes.tapered) {
    std::vector<Vec<2>> profile;
    for (const auto& [z, radius] : tapered.profile) profile.push_back({z + 0.5 * c.wheel.width, radius});
    for_each_in_sector(c, tapered.count, tapered.phase, [&](double azimuth) {
      holes.push_back({tapered.center_radius, azimuth, profile});
    });
  }
  return holes;
}

long long axial_nodes(const Case& c) {
  return c.wheel.dimension == 3 ? static_cast<long long>(c.grid.degree) * c.grid.axial_cells + 1 : 1;
}

long long dof_bound(const Case& c) {
  const long long radial = static_cast<long long>(c.grid.degree) * c.grid.radial_cells + 1;
  const long long angular = static_cast<long long>(c.grid.degree) * c.grid.angular_cells;
  return c.wheel.dimension * radial * angular * axial_nodes(c);
}

namespace {

/// `stiffness`: of the normal strain at the tread, in units of the modulus that scales gamma.
double gamma_0_for(double theta, double stiffness, double aspect) {
  constexpr double reference = 8.8;  // (lambda + 2 mu) / E at nu = 0.48, where 10 and 100 were found
  constexpr double per_aspect =
      0.8;  // 0.80, 0.69, 0.55 and 0.58 were found at the aspects 2.3, 4.6, 9.2 and 19
  return stiffness / reference *
         (10 * (1 + theta) * (1 + theta) + 60 * std::max(theta, 0.0) * std::max(1.0, per_aspect * aspect));
}

}  // namespace

double minimum_gamma_0(double theta, const Material& material, double aspect) {
  // Without the indefinite term, a projected pressure needs no more as nu tends to 1/2.
  if (theta <= 0 && material.nearly_incompressible()) return 13.2 * (1 + theta) * (1 + theta);
  return gamma_0_for(theta, (material.lambda() + 2 * material.mu()) / material.scaling_modulus(), aspect);
}

double minimum_gamma_0(double theta, const OrthotropicMaterial& material, double aspect) {
  return gamma_0_for(theta, material.radial_stiffness() / material.scaling_modulus(), aspect);
}

double tread_cell_aspect(const Case& c) {
  return 2 * pi * c.wheel.outer_radius / c.grid.angular_cells / tread_row(c);
}

}  // namespace wheelwright
