#include "wheelwright/run/study/problem_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

bool wants_dual(const Case& c) {
  return c.objective.uniformity_dual > 0 || c.objective.annulus_matches_dual.has_value();
}

/// Number of tread columns that contact may reach [cells of the tread, before they are halved].
double contact_columns(const Case& c) {
  const double cell = 2 * pi * c.wheel.outer_radius / c.grid.angular_cells;
  const double half_width = c.contact.with == Counterpart::ring ? likely_half_width(c)
                            : c.load.travel ? std::sqrt(2 * contact_radius(c) * *c.load.travel)
                                            : hertz_half_width(c);
  constexpr double margin = 4;
  return std::min(2 * half_width / cell + margin, static_cast<double>(c.grid.angular_cells));
}

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
/// middle and grooves in one face count as asymmetric.
bool is_halved(const Case& c) {
  if (c.wheel.dimension != 3 || c.grid.axial_cells % 2 != 0) return false;
  for (const Case& single : single_load_cases(c))
    if (single.load.camber != 0 || single.load.lateral_force != 0) return false;
  return std::ranges::all_of(c.holes.spheres, [](const HoleSphere& sphere) { return sphere.z == 0; }) &&
         std::ranges::all_of(c.holes.tapered, is_even) &&
         std::ranges::all_of(c.holes.grooves,
                             [](const HoleGroove& groove) { return groove.side == GrooveSide::both; });
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

}  // namespace

ProblemSize problem_size(const Case& c) {
  const bool in_3d = c.wheel.dimension == 3;
  const double solved = is_halved(c) ? 0.5 : 1;
  const double per_line_node =
      c.wheel.dimension * solved * static_cast<double>(axial_nodes(c) + (solved < 1));
  const int axial_points = std::min(c.contact.quadrature_points, c.grid.degree + 1);
  const double points = c.contact.quadrature_points * (1 << tread_levels_of_results(c)) *
                        (in_3d ? axial_points * c.grid.axial_cells : 1);  // per column
  ProblemSize size{};
  size.dimension = c.wheel.dimension;
  size.is_halved = solved < 1;
  size.has_real_harmonics = has_real_harmonics(c);
  size.rings = 1 + wants_dual(c) + (tread_levels_of_results(c) > tread_levels(c));
  for (const HoleRing& ring : c.holes.rings) size.holes += ring.count / static_cast<double>(c.wheel.sectors);
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
  if (has_large_strains(c))
    size.rings_at_once =
        std::min<double>(c.load.positions, std::max(1U, std::thread::hardware_concurrency()));
  size.loaded_columns = std::min(size.columns / size.sectors, size.positions * size.zone_columns);
  return size;
}

ProblemSize problem_size_of_grooves(const Case& c) {
  ProblemSize size = problem_size(c);
  const double derivatives = size.radial_line * n_compared_derivatives(c.ghost_penalty, c.grid.degree);
  size.radial_line += derivatives;
  size.sector_dofs += 2 * derivatives;
  return size;
}

}  // namespace wheelwright
