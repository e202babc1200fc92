#include "wheelwright/case/fitting_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

int nearest_multiple(int n, int unit) {
  return unit * std::max(1, static_cast<int>(std::lround(static_cast<double>(n) / unit)));
}

/// Whether the annulus, if given, is a whole number of rows after that many halvings. With layers or cords,
/// lines move to it.
bool fits_annulus(const Case& c, int halvings) {
  if (!wants_annulus(c) || !c.objective.annulus || !radii_of_lines(c).empty()) return true;
  const double height = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
  const double rows = *c.objective.annulus / height / (1 << halvings);
  return rows > 0.5 && std::abs(rows - std::round(rows)) < 1e-6;
}

/// Whether there are enough rows for the lines at given radii, neighbours of which are similarly high, after
/// that many halvings.
bool fits_lines(Case c, int halvings) {
  constexpr double largest_ratio = 2;
  c.grid.radial_cells >>= halvings;
  return static_cast<int>(radii_of_lines(c).size()) < c.grid.radial_cells &&
         largest_row_ratio(polar_grid<2>(c)).ratio <= largest_ratio;
}

bool fits_bands(const Case& c) {
  const auto [rim, tread, between, mould, print] = bands(c);
  const PolarGrid<2> grid = polar_grid<2>(c);
  const int rows = grid.cells[0];
  const double rounding = 1e-9 * c.wheel.outer_radius;
  return rim.thickness >= grid.height_of_rows(0, rim.full_rows) - rounding &&
         tread.thickness >= grid.height_of_rows(rows - tread.full_rows, rows) - rounding;
}

bool has_fitting_rows(const Case& c) {
  const int levels = c.optimizer.coarse_levels;
  if (c.grid.radial_cells % (1 << levels) != 0 || !fits_annulus(c, levels) || !fits_lines(c, levels))
    return false;
  return fits_bands(c) && (levels == 0 || has_room_between_bands(c, levels));
}

int fitting_rows(Case c) {
  const int usual = c.grid.radial_cells;
  for (int distance = 0; distance <= usual; ++distance)
    for (const int rows : {usual + distance, usual - distance}) {
      if (rows < usual / 2) continue;
      c.grid.radial_cells = rows;
      if (has_fitting_rows(c)) return rows;
    }
  return usual;
}

}  // namespace

Case with_fitting_grid(Case c, const GivenCells& given) {
  const int halves = 1 << c.optimizer.coarse_levels;
  if (!given.angular) c.grid.angular_cells = nearest_multiple(c.grid.angular_cells, c.wheel.sectors * halves);
  if (!given.axial) c.grid.axial_cells = nearest_multiple(c.grid.axial_cells, halves);
  if (!given.radial && c.wheel.inner_radius < c.wheel.outer_radius) c.grid.radial_cells = fitting_rows(c);
  return c;
}

std::string nearest_multiples(int n, int unit) {
  const int below = n / unit * unit, above = below + unit;
  return below > 0 ? fmt::format("{} or {}", below, above) : fmt::format("{}", above);
}

}  // namespace wheelwright
