#include "wheelwright/case/fitting_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"

namespace wheelwright {
namespace {

int nearest_multiple(int n, int unit) {
  return unit * std::max(1, static_cast<int>(std::lround(static_cast<double>(n) / unit)));
}

double row_height(const Case& c) {
  return (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
}

bool fits_band(const Case& c, const Band& band) {
  return band.thickness >= band.full_rows * row_height(c) - 1e-9 * c.wheel.outer_radius;
}

/// Whether the annulus, if given, is a whole number of rows after that many halvings.
bool fits_annulus(const Case& c, int halvings) {
  if (!wants_annulus(c) || !c.objective.annulus) return true;
  const double rows = *c.objective.annulus / row_height(c) / (1 << halvings);
  return rows > 0.5 && std::abs(rows - std::round(rows)) < 1e-6;
}

bool has_fitting_rows(const Case& c) {
  const int levels = c.optimizer.coarse_levels;
  if (c.grid.radial_cells % (1 << levels) != 0 || !fits_annulus(c, levels) ||
      !layers_fit(c, c.grid.radial_cells >> levels))
    return false;
  const auto [rim, tread, between] = bands(c);
  return fits_band(c, rim) && fits_band(c, tread) && (levels == 0 || has_room_between_bands(c, levels));
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
