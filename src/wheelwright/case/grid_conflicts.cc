#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/fitting_grid.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

/// The numbers of nodes and unknowns are stored as int.
void check_size(const Case& c, Conflicts& found) {
  constexpr long long most = 1'000'000'000;
  if (dof_bound(c) <= most) return;
  found.push_back({{key_of(&Grid::radial_cells), key_of(&Grid::angular_cells), key_of(&Grid::axial_cells),
                    key_of(&Grid::degree)},
                   fmt::format("the grid has up to {} unknowns", dof_bound(c)),
                   fmt::format("use a grid with at most {}", most)});
}

void check_angular_cells(const Case& c, Conflicts& found) {
  const int cells = c.grid.angular_cells, sectors = c.wheel.sectors;
  if (cells % sectors == 0) return;
  found.push_back({{key_of(&Grid::angular_cells), key_of(&Wheel::sectors)},
                   fmt::format("must be a multiple of wheel.sectors = {}", sectors),
                   fmt::format("nearest valid: {}", nearest_multiples(cells, sectors))});
}

/// For sizes that cannot be halved, the nearest that can.
std::string halvable_cells(const Case& c, int times) {
  const int parts = 1 << times;
  std::vector<std::string> sizes;
  const auto add = [&](const CaseKey& key, int cells, int unit) {
    if (cells % unit != 0)
      sizes.push_back(fmt::format("{} = {}", key.path(), nearest_multiples(cells, unit)));
  };
  add(key_of(&Grid::radial_cells), c.grid.radial_cells, parts);
  add(key_of(&Grid::angular_cells), c.grid.angular_cells, parts * c.wheel.sectors);
  if (c.wheel.dimension == 3) add(key_of(&Grid::axial_cells), c.grid.axial_cells, parts);
  return fmt::format("{}", fmt::join(sizes, ", "));
}

/// The coarser grids must have whole cells in each sector, room between their wider bands, and whole rows in
/// the annulus.
void check_coarse_levels(const Case& c, Conflicts& found) {
  const int levels = c.optimizer.coarse_levels;
  if (levels == 0 || c.wheel.inner_radius >= c.wheel.outer_radius ||
      c.grid.angular_cells % c.wheel.sectors != 0)
    return;
  const auto refuse = [&](CaseKeys keys, std::string problem, std::string remedy) {
    keys.insert(keys.begin(), key_of(&Optimizer::coarse_levels));
    found.push_back({std::move(keys), std::move(problem), std::move(remedy)});
  };
  if (!can_be_halved(c, levels)) {
    int possible = levels;
    while (!can_be_halved(c, possible)) --possible;
    refuse({key_of(&Grid::radial_cells), key_of(&Grid::angular_cells), key_of(&Wheel::sectors)},
           fmt::format("{} x {} cells of each sector cannot be doubled {} times", c.grid.radial_cells,
                       c.grid.angular_cells / c.wheel.sectors, levels),
           fmt::format("use {}, or grids that can be: {}", possible, halvable_cells(c, levels)));
    return;
  }
  const Case coarse = on_coarser_grid(c, levels);
  if (static_cast<int>(radii_of_lines(c).size()) >= coarse.grid.radial_cells) {
    refuse({key_of(&Grid::radial_cells)},
           fmt::format(
               "the coarse grid of {} rows has none for some of the {} parts into which layers and cords "
               "divide the ring",
               coarse.grid.radial_cells, radii_of_lines(c).size() + 1),
           "use fewer coarse_levels");
    return;
  }
  const double cell = polar_grid<2>(coarse).row_height(coarse.grid.radial_cells - 1);
  if (wants_annulus(c) && std::abs(annulus_thickness(c) - tread_rows(coarse) * cell) > 1e-6 * cell)
    refuse({key_of(&Objective::annulus), key_of(&Grid::radial_cells)},
           fmt::format("the annulus of {:.6g} m is not a whole number of coarse cells of {:.6g} m",
                       annulus_thickness(c), cell),
           fmt::format("use fewer coarse_levels, or objective.annulus = {:.6g}", tread_rows(coarse) * cell));
  if (!has_room_between_bands(c, levels))
    refuse(with_ring_shape({}), "on the coarse grid the bands at rim and tread leave no room for holes",
           "use fewer coarse_levels, or a finer grid");
}

}  // namespace

void grid_conflicts(const Case& c, Conflicts& found) {
  check_size(c, found);
  check_angular_cells(c, found);
  check_coarse_levels(c, found);
}

}  // namespace wheelwright
