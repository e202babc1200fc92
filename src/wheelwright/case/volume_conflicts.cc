#include <fmt/format.h>

#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

constexpr double square(double x) { return x * x; }

}  // namespace

/// The bands at rim and tread remain material, and the rest of the ring must not be full: there is at least a
/// hole of one cell in every sector.
void volume_conflicts(const Case& c, Conflicts& found) {
  const Wheel& w = c.wheel;
  const auto [rim, tread, between, mould, print] = bands(c);
  const double low = w.inner_radius + rim.thickness, high = w.outer_radius - tread.thickness;
  if (!c.volume.target || low >= high) return;
  if (!has_holes(c) && c.optimizer.nucleation == NucleationTime::never) {
    found.push_back({{key_of(&Volume::target)},
                     "there are no holes that could grow or shrink",
                     "add holes, or set optimizer.nucleation = \"converged\", or omit the key"});
    return;
  }
  const double ring = square(w.outer_radius) - square(w.inner_radius);
  double least = 1 - (square(high) - square(low)) / ring;
  for (const SolidAnnulus& solid : between) least += (square(solid.outer) - square(solid.inner)) / ring;
  const double most = 1 - double(w.sectors) / (double(c.grid.radial_cells) * c.grid.angular_cells);
  if (*c.volume.target <= least)
    found.push_back(
        {with_ring_shape({key_of(&Volume::target)}),
         fmt::format("the bands at rim and tread{}, which remain material, are {:.6g} of the ring",
                     between.empty() ? "" : " and the layers without holes", least),
         fmt::format("use more than {:.3g}, or thinner bands", rounded_up(least))});
  if (*c.volume.target > most)
    found.push_back({{key_of(&Volume::target), key_of(&Grid::radial_cells), key_of(&Grid::angular_cells),
                      key_of(&Wheel::sectors)},
                     "holes of one cell in every sector leave less material than that",
                     fmt::format("use at most {:.9g}, or a finer grid", std::floor(most * 1e9) / 1e9)});
}

}  // namespace wheelwright
