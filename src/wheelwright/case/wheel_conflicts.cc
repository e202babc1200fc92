#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

/// A band covers the rows of cells that must be full, of which `least` is the height [m].
void check_band(const Case& c, const Band& band, double least, std::string_view place, const CaseKey& key,
                bool is_given, Conflicts& found) {
  const double advised = rounded_up(least);
  if (band.thickness >= least - 1e-9 * c.wheel.outer_radius) return;
  const auto rows =
      band.full_rows == 1 ? std::string("one radial cell") : fmt::format("{} radial cells", band.full_rows);
  if (is_given) {
    found.push_back({{key, key_of(&Grid::radial_cells), key_of(&Objective::annulus)},
                     "thinner than " + rows,
                     fmt::format("use at least {:.6g} m, or more grid.radial_cells", advised)});
  } else {
    const double finer = std::ceil(c.grid.radial_cells * least / band.thickness - 1e-9);
    CaseKeys keys{key_of(&Grid::radial_cells), key, key_of(&Objective::annulus)};
    if (!c.layers.empty()) keys.push_back(table_of<MaterialLayer>(0));  // which move rows
    if (!c.cords.empty()) keys.push_back(table_of<MaterialCord>(0));
    found.push_back(
        {std::move(keys),
         fmt::format("{} {} thicker than the band at the {} that remains material, by default {:.6g} m", rows,
                     band.full_rows == 1 ? "is" : "are", place, band.thickness),
         fmt::format("use at least {:.0f}, or set {} = {:.6g} or more", finer, key.path(), advised)});
  }
}

}  // namespace

void wheel_conflicts(const Case& c, Conflicts& found) {
  const Wheel& w = c.wheel;
  if (w.inner_radius >= w.outer_radius) {
    found.push_back({{key_of(&Wheel::outer_radius), key_of(&Wheel::inner_radius)},
                     fmt::format("must be larger than inner_radius = {} m", w.inner_radius),
                     "set the radius of the rim as inner_radius and that of the tread as outer_radius" +
                         if_in_millimetres(w.inner_radius, w.outer_radius)});
    return;
  }
  constexpr double thinnest = 1e-4;
  if (w.outer_radius - w.inner_radius < thinnest * w.outer_radius) {
    found.push_back({{key_of(&Wheel::outer_radius), key_of(&Wheel::inner_radius)},
                     fmt::format("the ring is thinner than {} times its radius", thinnest),
                     fmt::format("use outer_radius >= {:.6g} m", w.inner_radius / (1 - 2 * thinnest))});
    return;
  }
  const auto [rim, tread, between, mould, print] = bands(c);
  const PolarGrid<2> grid = polar_grid<2>(c);
  const int rows = grid.cells[0];
  check_band(c, rim, grid.height_of_rows(0, rim.full_rows), "rim", key_of(&Optimizer::rim_band),
             c.optimizer.rim_band.has_value(), found);
  check_band(c, tread, grid.height_of_rows(rows - tread.full_rows, rows), "tread",
             key_of(&Optimizer::tread_band), c.optimizer.tread_band.has_value(), found);
  if (rim.thickness + tread.thickness >= w.outer_radius - w.inner_radius) {
    found.push_back(
        {with_ring_shape({key_of(&Optimizer::rim_band), key_of(&Optimizer::tread_band),
                          key_of(&Optimizer::minimum_wall)}),
         fmt::format("the bands at rim and tread, {:.6g} m and {:.6g} m, fill the whole ring of {:.6g} m",
                     rim.thickness, tread.thickness, w.outer_radius - w.inner_radius),
         "use thinner bands (by default they are at least as thick as optimizer.minimum_wall) or a finer "
         "grid" +
             if_in_millimetres(std::max(rim.thickness, tread.thickness), w.outer_radius)});
  }
}

}  // namespace wheelwright
