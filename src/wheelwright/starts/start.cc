#include "wheelwright/starts/start.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/run/study.h"
#include "wheelwright/starts/draft.h"

namespace wheelwright {
namespace {

constexpr int most_attempts = 200;
constexpr double volume_tolerance = 1e-3;

/// One of the kinds, in turn, so that even few starts hold several; rings come most often.
std::optional<Draft> draft(const DraftSpace& space, Random& random, int number) {
  switch (number % 10) {
    case 0:
    case 5:
      return draft_rings(space, random, 2, true);
    case 1:
      return draft_rings(space, random, 1, false);
    case 2:
      return draft_rings(space, random, 2, false);
    case 3:
      return draft_spokes(space, random, random.coin() ? SpokeKind::straight : SpokeKind::curved);
    case 4:
      return draft_slots(space, random);
    case 6:
      return draft_rings(space, random, 3, true);
    case 7:
      return draft_spokes(space, random, random.coin() ? SpokeKind::forked : SpokeKind::pair);
    case 8:
      return draft_ellipses(space, random);
    default:
      return draft_rings(space, random, 3, false);
  }
}

DraftSpace draft_space(const Case& c, const StartRange& range) {
  const auto [inner, outer] = free_region(c);
  constexpr double thinnest = 1.5;  // cells
  const double wall = std::max({thinnest * polar_grid<2>(c).resolution(),
                                c.optimizer.minimum_wall.value_or(0), c.optimizer.minimum_gap.value_or(0)});
  return {inner, outer, wall, range.keeps_sectors ? c.wheel.sectors : 1};
}

/// About as many cells as the case has, a multiple of the sectors and, where the case's can be halved, of
/// twice as many.
int angular_cells(const Case& c, int sectors) {
  int unit = sectors;
  if (can_be_halved(c, 1)) unit *= 2;
  return unit * std::max(1, static_cast<int>(std::lround(double(c.grid.angular_cells) / unit)));
}

/// The case with a draft of some size in place of its holes and shapes.
Case drawn(const Case& c, const StartRange& range, const Draft& draft, double size) {
  Case result = c;
  result.holes = {};
  result.shapes = {};
  result.saved_shape = {};
  result.expectations = {};
  result.volume.target = range.volume;
  result.wheel.sectors = draft.sectors;
  result.grid.angular_cells = angular_cells(c, draft.sectors);
  draft.draw(result, size);
  return result;
}

/// The size at which the draft has the volume of the range; nothing if none between its bounds has.
std::optional<double> matching_size(const Case& c, const StartRange& range, const Draft& draft) {
  double low = draft.least, high = draft.most;
  const auto excess = [&](double size) {
    return initial_volume(drawn(c, range, draft, size)) - range.volume;
  };
  double at_low = excess(low), at_high = excess(high);
  if (!(at_low * at_high <= 0)) return {};
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high), there = excess(middle);
    if (!std::isfinite(there)) return {};
    if (std::abs(there) < volume_tolerance) return middle;
    (there * at_low > 0 ? low : high) = middle;
    (there * at_low > 0 ? at_low : at_high) = there;
  }
  return {};
}

bool is_valid(const Case& c) {
  return parse_case(to_toml(c), "start.toml").value && lost_on_the_grid<2>(c).empty();
}

}  // namespace

double initial_volume(const Case& c) {
  const LevelSet<2> shape = initial_shape<2>(c);
  return volume_fraction<2>(shape.lattice.grid(), material_measure(shape));
}

std::optional<Start> draw_start(const Case& c, const StartRange& range, std::uint64_t seed, int number) {
  Random random(seed, static_cast<std::uint64_t>(number));
  const DraftSpace space = draft_space(c, range);
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    // A kind that finds no room gives way to the next one.
    const auto chosen = draft(space, random, number + attempt / 20);
    if (!chosen) continue;
    const auto size = matching_size(c, range, *chosen);
    if (!size) continue;
    Case result = drawn(c, range, *chosen, *size);
    if (!is_valid(result)) continue;
    result.title = chosen->text;
    return Start{chosen->text, std::move(result)};
  }
  return {};
}

}  // namespace wheelwright
