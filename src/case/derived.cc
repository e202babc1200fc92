#include "case/derived.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheelwright {

using std::numbers::pi;

double load_per_metre(const Case& c) { return c.load.force / c.wheel.width; }

double hertz_half_width(const Case& c) {
  return 2 * std::sqrt(load_per_metre(c) * c.wheel.outer_radius / (pi * c.material.plane_strain_modulus()));
}

double hertz_peak_pressure(const Case& c) { return 2 * load_per_metre(c) / (pi * hertz_half_width(c)); }

double tread_cell_width(const Case& c) {
  return 2 * pi * c.wheel.outer_radius / c.grid.angular_cells / (1 << c.grid.tread_levels);
}

double cells_per_contact_patch(const Case& c) { return 2 * hertz_half_width(c) / tread_cell_width(c); }

double sector_angle(const Case& c) { return 2 * pi / c.wheel.sectors; }

int total_load_positions(const Case& c) { return c.wheel.sectors * c.load.positions; }

namespace {
double radial_cell(const Case& c) {
  return (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
}
}  // namespace

double least_rim_band(const Case& c) { return radial_cell(c); }

double least_tread_band(const Case& c) { return (tread_rows(c) + 1) * radial_cell(c); }

bool wants_annulus(const Case& c) {
  return c.objective.uniformity_annulus > 0 || c.objective.annulus_matches_dual.has_value();
}

double annulus_thickness(const Case& c) { return c.objective.annulus.value_or(radial_cell(c)); }

double characteristic_length(const Case& c) { return c.objective.length.value_or(annulus_thickness(c)); }

int tread_rows(const Case& c) {
  if (!wants_annulus(c)) return 1;
  return std::max(1, static_cast<int>(std::lround(annulus_thickness(c) / radial_cell(c))));
}

double rim_band(const Case& c) { return c.optimizer.rim_band.value_or(least_rim_band(c)); }

double tread_band(const Case& c) { return c.optimizer.tread_band.value_or(least_tread_band(c)); }

std::vector<Circle> sector_holes(const Case& c) {
  std::vector<Circle> holes;
  for (const HoleRing& ring : c.holes.rings) {
    const double spacing = 2 * pi / ring.count, first = ring.phase.value_or(spacing / 2);
    for (int i = 0; i < ring.count / c.wheel.sectors; ++i)
      holes.push_back({ring.center_radius, first + i * spacing, ring.radius});
  }
  for (const HoleCircle& circle : c.holes.circles) {
    const auto [x, y] = circle.center;
    holes.push_back({std::hypot(x, y), std::atan2(y, x), circle.radius});
  }
  return holes;
}

long long dof_bound(const Case& c) {
  const long long radial = static_cast<long long>(c.grid.degree) * c.grid.radial_cells + 1;
  const long long angular = static_cast<long long>(c.grid.degree) * c.grid.angular_cells;
  return 2 * radial * angular;
}

double estimated_memory(const Case& c) {
  constexpr double libraries = 200e6, number = sizeof(double), complex = 2 * sizeof(double);
  const double sectors = c.wheel.sectors;
  const double sector_dofs = dof_bound(c) / sectors;
  const double radial_line = 2 * (c.grid.degree * c.grid.radial_cells + 1);
  const double tread_layer = 2 * (c.grid.degree + 1) * c.grid.degree * c.grid.angular_cells / sectors;
  const double trailing = 2 * radial_line + tread_layer;

  // Nested dissection of a planar grid fills about 31/4 n log2 n entries for n unknowns.
  const double factor = number * 31.0 / 4 * sector_dofs * std::log2(std::max(sector_dofs, 2.0));
  const double trailing_block = 2 * number * trailing * trailing;
  const double harmonics = complex * (sectors / 2 + 1) * radial_line * radial_line;
  const double fields = number * static_cast<double>(dof_bound(c)) * (4 + 2 * c.load.positions);
  return libraries + factor + trailing_block + harmonics + fields;
}

double least_gamma_0(double theta, const Material& material) {
  constexpr double reference = 8.8;  // (lambda + 2 mu) / E at nu = 0.48, where 10 and 100 were found
  const double stiffness = (material.lambda() + 2 * material.mu()) / material.youngs_modulus / reference;
  return stiffness * (10 * (1 + theta) * (1 + theta) + 60 * std::max(theta, 0.0));
}

}  // namespace wheelwright
