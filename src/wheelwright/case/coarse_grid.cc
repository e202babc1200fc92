#include "wheelwright/case/coarse_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {

namespace {

constexpr double coarse_tolerance = 5e-3;
constexpr int most_tread_levels = 6;

}  // namespace

Case on_coarser_grid(Case c, int level) {
  if (level == 0) return c;
  if (wants_annulus(c)) c.objective.annulus = annulus_thickness(c);
  c.objective.length = characteristic_length(c);
  c.grid.radial_cells >>= level;
  c.grid.angular_cells = c.wheel.sectors * std::max(1, (c.grid.angular_cells / c.wheel.sectors) >> level);
  c.grid.axial_cells = std::max(1, c.grid.axial_cells >> level);
  if (c.grid.tread_levels)
    c.grid.tread_levels =
        std::min(*c.grid.tread_levels + level, std::max(most_tread_levels, *c.grid.tread_levels));
  const auto [rim, tread, between, mould, print] = bands(c);
  const PolarGrid<2> grid = polar_grid<2>(c);
  const int rows = grid.cells[0];
  c.optimizer.rim_band = std::max(rim.thickness, grid.height_of_rows(0, rim.full_rows));
  c.optimizer.tread_band = std::max(tread.thickness, grid.height_of_rows(rows - tread.full_rows, rows));
  c.optimizer.tolerance = std::max(convergence_tolerance(c), coarse_tolerance);
  c.optimizer.coarse_levels = 0;
  return c;
}

bool can_be_halved(const Case& c, int times) {
  const int parts = 1 << times;
  if (c.wheel.dimension == 3 && c.grid.axial_cells % parts != 0) return false;
  return c.grid.radial_cells % parts == 0 && c.grid.angular_cells % (parts * c.wheel.sectors) == 0;
}

bool has_room_between_bands(const Case& c, int level) {
  const Case coarse = on_coarser_grid(c, level);
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius;
  const auto [rim, tread, between, mould, print] = bands(coarse);
  return rim.thickness + tread.thickness < ring - largest_row_height(polar_grid<2>(coarse));
}

int level_with_few_cells(const Case& c, int most_cells) {
  const int min_rows = std::max(6, static_cast<int>(radii_of_lines(c).size()) + 1);
  const Grid& grid = c.grid;
  int level = 0;
  while ((grid.radial_cells >> level) * (grid.angular_cells >> level) > most_cells &&
         grid.radial_cells >> (level + 1) >= min_rows)
    ++level;
  return level;
}

std::string grid_text(const Case& c) {
  const std::string along_axle = c.wheel.dimension == 3 ? fmt::format(" x {}", c.grid.axial_cells) : "";
  return fmt::format("grid {} x {}{}", c.grid.radial_cells, c.grid.angular_cells, along_axle);
}

}  // namespace wheelwright
