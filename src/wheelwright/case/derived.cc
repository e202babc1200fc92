#include "wheelwright/case/derived.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/case/dimension.h"
#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/elasticity/element.h"

namespace wheelwright {

using std::numbers::pi;

Case with_load_case(Case c, int load_case) {
  const CaseLoad changes = c.load.cases[load_case];
  Load& load = c.load;
  load.cases.clear();
  if (changes.force) {
    load.force = *changes.force;
    load.travel.reset();
  }
  if (changes.travel) load.travel = changes.travel;
  load.horizontal_force = changes.horizontal_force.value_or(load.horizontal_force);
  load.torque = changes.torque.value_or(load.torque);
  load.body_force = changes.body_force.value_or(load.body_force);
  load.hole_pressure = changes.hole_pressure.value_or(load.hole_pressure);
  load.speed = changes.speed.value_or(load.speed);
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

double hertz_half_width(const Case& c) {
  return 2 * std::sqrt(load_per_metre(c) * c.wheel.outer_radius / (pi * c.material.contact_modulus()));
}

double hertz_peak_pressure(const Case& c) { return 2 * load_per_metre(c) / (pi * hertz_half_width(c)); }

double likely_half_width(const Case& c) {
  if (c.contact.with == Counterpart::ring) return pi * c.wheel.outer_radius;
  // A travel d makes a patch of about sqrt(0.4 R_e d): the logarithm in the compliance of a roller is near 5.
  return c.load.travel ? std::sqrt(0.4 * c.wheel.outer_radius * *c.load.travel) : hertz_half_width(c);
}

namespace {

/// The smallest number of halvings that gives so many cells per patch, within so many points per column; in
/// 3D none.
int levels_for(const Case& c, double cells_per_patch, int most_points) {
  if (c.wheel.dimension == 3) return 0;
  const double cell = 2 * pi * c.wheel.outer_radius / c.grid.angular_cells;
  int levels = 0;
  while (2 * likely_half_width(c) * (1 << levels) < cells_per_patch * cell &&
         c.contact.quadrature_points * (2 << levels) <= most_points)
    ++levels;
  return levels;
}

/// As many as needed by the load case with the narrowest contact.
int most_levels_for(const Case& c, double cells_per_patch, int most_points) {
  int levels = 0;
  for (const Case& single : single_load_cases(c))
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

int level_set_degree(const Case& c) {
  return c.grid.level_set_degree.value_or(c.wheel.dimension == 3 ? 1 : 2);
}

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
  const double radial = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells,
               azimuthal = pi * (c.wheel.outer_radius + c.wheel.inner_radius) / c.grid.angular_cells;
  double smallest = smallest_hole_width(c);
  for (const HoleSphere& sphere : c.holes.spheres) smallest = std::min(smallest, 2 * sphere.radius);
  const auto add = [&](Fill as, double diameter) {
    if (as == Fill::hole) smallest = std::min(smallest, diameter);
  };
  for (const CircleShape& circle : c.shapes.circles) add(circle.as, 2 * circle.radius);
  for (const EllipseShape& ellipse : c.shapes.ellipses)
    add(ellipse.as, std::min(ellipse.length, ellipse.width));
  for (const SlotShape& slot : c.shapes.slots) add(slot.as, slot.width);
  return smallest / std::max(radial, azimuthal);
}

double cells_per_contact_patch(const Case& c) { return 2 * likely_half_width(c) / tread_cell_width(c); }

double sector_angle(const Case& c) { return 2 * pi / c.wheel.sectors; }

int total_load_positions(const Case& c) { return c.wheel.sectors * c.load.positions; }

namespace {
double radial_cell(const Case& c) {
  return (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
}
}  // namespace

bool minimizes_weighted_sum(const Case& c) { return c.objective.minimize == Quantity(); }

bool holds_volume(const Case& c) {
  const auto is_free = [](const Quantity& quantity) { return quantity->is_amount_of_material; };
  return !is_free(c.objective.minimize) &&
         std::ranges::none_of(c.constraints, is_free, &Constraint::quantity);
}

namespace {

/// Whether quantities with this property are minimized, bounded or terms of the weighted sum.
bool optimizes_any(const Case& c, bool QuantityRow::*property) {
  const auto has_it = [&](const Quantity& quantity) { return (*quantity).*property; };
  const auto is_such_term = [&](const ObjectiveWeight& term) {
    return c.objective.*term.weight > 0 && has_it(built_in(term.quantity));
  };
  return has_it(c.objective.minimize) || std::ranges::any_of(c.constraints, has_it, &Constraint::quantity) ||
         std::ranges::any_of(objective_weights, is_such_term);
}

}  // namespace

bool wants_annulus(const Case& c) {
  return c.objective.annulus_matches_dual.has_value() || optimizes_any(c, &QuantityRow::observes_annulus);
}

bool wants_uniformity(const Case& c) {
  return c.objective.annulus_matches_dual.has_value() || optimizes_any(c, &QuantityRow::compares_with_mean);
}

double annulus_thickness(const Case& c) { return c.objective.annulus.value_or(radial_cell(c)); }

double characteristic_length(const Case& c) { return c.objective.length.value_or(annulus_thickness(c)); }

int tread_rows(const Case& c) {
  if (!wants_annulus(c)) return 1;
  return std::max(1, static_cast<int>(std::lround(annulus_thickness(c) / radial_cell(c))));
}

template <int dim>
PolarGrid<dim> polar_grid(const Case& c) {
  PolarGrid<dim> grid{c.wheel.inner_radius, c.wheel.outer_radius, c.wheel.width, c.wheel.sectors,
                      std::array<int, dim>{}};
  grid.cells[0] = c.grid.radial_cells;
  grid.cells[1] = c.grid.angular_cells / c.wheel.sectors;
  if constexpr (dim == 3) grid.cells[2] = c.grid.axial_cells;
  return grid;
}
template decltype(polar_grid<2>) polar_grid<2>;
template decltype(polar_grid<3>) polar_grid<3>;

Bands bands(const Case& c) {
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius, usual = ring / 14;
  const double with_annulus = wants_annulus(c) ? annulus_thickness(c) + ring / 28 : 0;
  const double wall = c.optimizer.minimum_wall.value_or(0);
  return {
      .rim = {c.optimizer.rim_band.value_or(std::max(usual, wall)), 1},
      .tread = {c.optimizer.tread_band.value_or(std::max({usual, with_annulus, wall})), tread_rows(c) + 1}};
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

namespace {

/// Nodes of the displacement along the axle.
long long axial_nodes(const Case& c) {
  return c.wheel.dimension == 3 ? static_cast<long long>(c.grid.degree) * c.grid.axial_cells + 1 : 1;
}

}  // namespace

long long dof_bound(const Case& c) {
  const long long radial = static_cast<long long>(c.grid.degree) * c.grid.radial_cells + 1;
  const long long angular = static_cast<long long>(c.grid.degree) * c.grid.angular_cells;
  return c.wheel.dimension * radial * angular * axial_nodes(c);
}

namespace {

bool wants_dual(const Case& c) {
  return c.objective.uniformity_dual > 0 || c.objective.annulus_matches_dual.has_value();
}

/// Number of tread columns that contact may reach [cells of the tread, before they are halved].
double contact_columns(const Case& c) {
  const double cell = 2 * pi * c.wheel.outer_radius / c.grid.angular_cells;
  const double half_width = c.contact.with == Counterpart::ring ? likely_half_width(c)
                            : c.load.travel ? std::sqrt(2 * c.wheel.outer_radius * *c.load.travel)
                                            : hertz_half_width(c);
  constexpr double margin = 4;
  return std::min(2 * half_width / cell + margin, static_cast<double>(c.grid.angular_cells));
}

constexpr double square(double x) { return x * x; }
constexpr double cube(double x) { return x * x * x; }

/// Whether the profile of a tapered hole is symmetric about the middle of the width.
bool is_even(const HoleTapered& hole) {
  const auto& profile = hole.profile;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const auto &there = profile[profile.size() - 1 - k], &here = profile[k];
    if (std::abs(here[0] + there[0]) > 1e-12 || std::abs(here[1] - there[1]) > 1e-12) return false;
  }
  return true;
}

/// Whether wheel and loads are symmetric across the width, so that half of it is solved. Spheres off the
/// middle count as asymmetric.
bool is_halved(const Case& c) {
  if (c.wheel.dimension != 3 || c.grid.axial_cells % 2 != 0) return false;
  for (const Case& single : single_load_cases(c))
    if (single.load.camber != 0 || single.load.lateral_force != 0) return false;
  return std::ranges::all_of(c.holes.spheres, [](const HoleSphere& sphere) { return sphere.z == 0; }) &&
         std::ranges::all_of(c.holes.tapered, is_even);
}

/// Whether the holes of a case are symmetric about the plane of azimuth 0, so that its harmonics are real.
/// Drawn shapes count as asymmetric.
bool has_real_harmonics(const Case& c) {
  if (c.shapes != Shapes{} || !c.holes.circles.empty()) return false;
  const auto is_its_image = [](const auto& hole) {
    const double spacings = hole.phase.value_or(0) * hole.count / pi;  // between the hole and its image
    return std::abs(spacings - std::round(spacings)) < 1e-9;
  };
  return std::ranges::all_of(c.holes.rings, is_its_image) &&
         std::ranges::all_of(c.holes.spheres, is_its_image) &&
         std::ranges::all_of(c.holes.tapered, is_its_image);
}

/// The sizes that determine memory and time of a run. For a wheel solved on half of its width, those of the
/// half except `dofs`, `cells` and `observed`.
struct ProblemSize {
  double sectors, positions;
  double columns, cells;          ///< of the full ring
  double dofs, sector_dofs;       ///< if every cell held material
  double radial_line, ring_line;  ///< dofs of a face between sectors, and of the core's outer line
  double tractions;               ///< components at the contact points of a column
  double observed;                ///< numbers observed per column of the tread
  double zone_columns, loaded_columns;

  double sector_line() const { return ring_line / sectors; }
  double boundary() const { return radial_line + sector_line(); }
  /// Boundary unknowns of the harmonics if they are complex: of large interfaces only the strong modes.
  double complex_boundary() const {
    return (has_strong_modes() ? radial_line / 3 : radial_line) + sector_line();
  }
  bool has_strong_modes() const { return radial_line >= 1000 && sectors >= 10; }
};

ProblemSize problem_size(const Case& c) {
  const bool in_3d = c.wheel.dimension == 3;
  const double solved = is_halved(c) ? 0.5 : 1;
  const double per_line_node =
      c.wheel.dimension * solved * static_cast<double>(axial_nodes(c) + (solved < 1));
  const int axial_points = std::min(c.contact.quadrature_points, c.grid.degree + 1);
  const double points = c.contact.quadrature_points * (1 << tread_levels_of_results(c)) *
                        (in_3d ? axial_points * c.grid.axial_cells : 1);  // per column
  ProblemSize size{};
  size.sectors = c.wheel.sectors;
  size.positions = c.load.positions * static_cast<double>(std::max<std::size_t>(c.load.cases.size(), 1));
  size.columns = c.grid.angular_cells;
  size.cells = size.columns * c.grid.radial_cells * (in_3d ? c.grid.axial_cells : 1);
  size.dofs = static_cast<double>(dof_bound(c));
  size.sector_dofs = solved * size.dofs / size.sectors;
  size.radial_line = per_line_node * (c.grid.degree * c.grid.radial_cells + 1);
  size.ring_line = per_line_node * c.grid.degree * size.columns;
  size.tractions = c.wheel.dimension * solved * points;
  size.observed = 2 * c.wheel.dimension * points;
  for (const Case& single : single_load_cases(c))
    size.zone_columns = std::max(size.zone_columns, contact_columns(single));
  size.loaded_columns = std::min(size.columns / size.sectors, size.positions * size.zone_columns);
  return size;
}

/// The number of copies of each array at the peak of memory, fitted to measurements.
struct Copies {
  double condensed, harmonics, surface;
};
constexpr Copies in_the_plane{3.5, 0.55, 0.1}, in_space{3, 0.55, 4};

/// The problem's size if a ghost penalty acts on all faces between sectors.
ProblemSize problem_size_of_grooves(const Case& c) {
  ProblemSize size = problem_size(c);
  const double derivatives = size.radial_line * n_compared_derivatives(c.ghost_penalty, c.grid.degree);
  size.radial_line += derivatives;
  size.sector_dofs += 2 * derivatives;
  return size;
}

double estimated_memory(const Case& c, const ProblemSize& n) {
  constexpr double number = sizeof(double), complex = 2 * number;
  const bool in_3d = c.wheel.dimension == 3;
  const Copies& copies = in_3d ? in_space : in_the_plane;
  double holes = 0;
  for (const HoleRing& ring : c.holes.rings) holes += ring.count / n.sectors;

  const double libraries = 26e6;
  const double fields = number * (is_halved(c) ? 0.5 : 1) * (56 * n.cells + 4.6 * n.dofs * n.positions);
  // Fill of nested dissection: n log n in the plane, n^(4/3) in space.
  const double fill = in_3d ? 6 * std::pow(n.sector_dofs, 4.0 / 3)
                            : 0.6 * n.sector_dofs * std::log2(std::max(n.sector_dofs, 2.0));
  const double factor = number * fill;
  const double condensed = number * copies.condensed * square(2 * n.radial_line + n.sector_line());
  const bool real_harmonics = in_3d && has_real_harmonics(c);
  const double harmonics =
      copies.harmonics * (n.sectors / 2 + 1) *
      (real_harmonics ? number * square(n.boundary()) : complex * square(n.complex_boundary()));
  // Right-hand sides on the outer line that are solved together.
  const double responses = number * 5 * 192 * n.ring_line;
  const double surface =
      number * copies.surface * (2 * n.zone_columns - 1) * n.loaded_columns * square(n.tractions);
  const double tread = number * (8 * square(2 * n.tractions) + 1.8 * n.observed * n.columns * n.positions);
  const double zones = number * 0.1 * n.positions * square(n.zone_columns * n.tractions);
  const double shape = number * 10 * holes;
  // The dual norm has its own ring, and so does a finer tread of the results.
  const double rings = 1 + wants_dual(c) + (tread_levels_of_results(c) > tread_levels(c));
  return libraries + fields + rings * (factor + condensed + harmonics) + responses + surface + tread + zones +
         shape;
}

double estimated_seconds_in_3d(const Case& c, const ProblemSize& n) {
  const bool real = has_real_harmonics(c);
  constexpr double flops_per_second = 45e9;  // dense matrices on one core
  const double boundary = real ? n.boundary() : n.complex_boundary();
  const double flops = cube(boundary) / 3 + 2 * cube(n.sector_line()) / 3;
  const double strong_modes = real || !n.has_strong_modes() ? 0 : 13 * cube(n.radial_line);
  const double harmonics = ((real ? 1 : 4) * (n.sectors / 2 + 1) * flops + strong_modes) / flops_per_second;
  const double sector = 2e-9 * square(n.sector_dofs);
  const double contact =
      (real ? 2.5e-7 : 6e-7) * (2 * n.zone_columns - 1) * n.loaded_columns * square(n.tractions);
  return harmonics + sector + contact;
}

}  // namespace

double estimated_memory(const Case& c) { return estimated_memory(c, problem_size(c)); }
double estimated_memory_of_grooves(const Case& c) { return estimated_memory(c, problem_size_of_grooves(c)); }
double estimated_seconds_in_3d(const Case& c) { return estimated_seconds_in_3d(c, problem_size(c)); }
double estimated_seconds_of_grooves_in_3d(const Case& c) {
  return estimated_seconds_in_3d(c, problem_size_of_grooves(c));
}

double minimum_gamma_0(double theta, const Material& material, double aspect) {
  constexpr double reference = 8.8;  // (lambda + 2 mu) / E at nu = 0.48, where 10 and 100 were found
  const double stiffness = (material.lambda() + 2 * material.mu()) / material.scaling_modulus() / reference;
  // Without the indefinite term, a projected pressure needs no more than the last material without
  // projection.
  if (theta <= 0 && material.nearly_incompressible()) return 13.2 * (1 + theta) * (1 + theta);
  constexpr double per_aspect =
      0.8;  // 0.80, 0.69, 0.55 and 0.58 were found at the aspects 2.3, 4.6, 9.2 and 19
  return stiffness *
         (10 * (1 + theta) * (1 + theta) + 60 * std::max(theta, 0.0) * std::max(1.0, per_aspect * aspect));
}

double tread_cell_aspect(const Case& c) {
  return 2 * pi * c.wheel.outer_radius / c.grid.angular_cells /
         ((c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells);
}

}  // namespace wheelwright
