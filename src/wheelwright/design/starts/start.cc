#include "wheelwright/design/starts/start.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/starts/draft.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

constexpr int max_attempts = 200;
/// Refused cases mostly have the same fault, which other holes do not repair.
constexpr int max_refused = 10;
constexpr double volume_tolerance = 1e-3;

/// The kinds take turns, so that even a few starts include several; rings are the most frequent.
std::optional<Draft> draft(const DraftSpace& space, Random& random, int number) {
  switch (number % n_kinds_of_starts) {
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
  const double wall =
      std::max({thinnest * polar_grid<2>(c).resolution(), c.optimizer.minimum_wall.value_or(0),
                c.optimizer.minimum_gap.value_or(0), 2 * c.optimizer.minimum_radius.value_or(0)});
  return {inner, outer, wall, range.keeps_sectors ? c.wheel.sectors : 1};
}

/// About as many cells as the case has, a multiple of the sectors that can be halved as often as its coarse
/// grids need, and once if the case's can.
int angular_cells(const Case& c, int sectors) {
  const int halvings = std::max(c.optimizer.coarse_levels, can_be_halved(c, 1) ? 1 : 0);
  const int unit = sectors << halvings;
  return unit * std::max(1, static_cast<int>(std::lround(double(c.grid.angular_cells) / unit)));
}

/// Load positions per sector. What a turn costs and wears depends on those around the wheel: then they are at
/// least as many as the case has.
int positions(const Case& c, int sectors) {
  const bool has_history = has_loss_factor(c) || has_fatigue_limit(c);
  return has_history ? (total_load_positions(c) + sectors - 1) / sectors : c.load.positions;
}

/// The case with a draft of this size instead of its holes and shapes.
Case drawn(const Case& c, const StartRange& range, const Draft& draft, double size) {
  Case result = c;
  result.holes = {};
  result.shapes = {};
  result.saved_shape = {};
  result.expectations = {};
  if (holds_volume(c)) result.volume.target = range.volume;
  result.wheel.sectors = draft.sectors;
  result.grid.angular_cells = angular_cells(c, draft.sectors);
  result.load.positions = positions(c, draft.sectors);
  draft.draw(result, size);
  return result;
}

/// The size at which the draft has the volume of the range; nothing if no size between its bounds has it.
std::optional<double> matching_size(const Case& c, const StartRange& range, const Draft& draft) {
  double low = draft.minimum, high = draft.most;
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

/// The first problem of a case; empty if it is valid.
std::string refusal(const Case& c) {
  const CaseResult checked = parse_case(to_toml(c), "start.toml", c.vocabulary);
  if (checked.value) return "";
  const Diagnostic& first = checked.problems.front();
  return fmt::format("{}: {}", first.key, first.problem);
}

/// One attempt at a start.
DrawnStart attempt(const Case& c, const StartRange& range, const std::optional<Draft>& draft) {
  if (!draft) return {{}, {.without_room = 1}};
  const auto size = matching_size(c, range, *draft);
  if (!size) return {{}, {.off_volume = 1}};
  Case result = drawn(c, range, *draft, *size);
  if (std::string problem = refusal(result); !problem.empty())
    return {{}, {.refused = 1, .refusal = std::move(problem)}};
  if (in_dimension_of(c, [&](auto dim) { return !lost_on_the_grid<dim>(result).empty(); }))
    return {{}, {.unresolved = 1}};
  result.title = draft->text;
  return {Start{draft->text, std::move(result)}, {}};
}

}  // namespace

double initial_volume(const Case& c) {
  return in_dimension_of(c, [&](auto dim) {
    const LevelSet<dim> shape = initial_shape<dim>(c);
    return volume_fraction<dim>(shape.lattice.grid(), material_measure(shape));
  });
}

FailedAttempts& FailedAttempts::operator+=(const FailedAttempts& other) {
  without_room += other.without_room;
  off_volume += other.off_volume;
  refused += other.refused;
  unresolved += other.unresolved;
  if (refusal.empty()) refusal = other.refusal;
  return *this;
}

std::string to_string(const FailedAttempts& attempts) {
  if (attempts.total() == 0) return "";
  std::vector<std::string> reasons;
  const auto add = [&](std::string_view reason, int n) {
    if (n > 0) reasons.push_back(fmt::format("{} {}", n, reason));
  };
  add("left no room for walls and gaps", attempts.without_room);
  add("could not have the volume", attempts.off_volume);
  add("lost walls or holes on the grid", attempts.unresolved);
  if (attempts.refused > 0) add(fmt::format("were refused ({})", attempts.refusal), attempts.refused);
  return fmt::format("{} attempts failed: {}", attempts.total(), fmt::join(reasons, ", "));
}

DrawnStart draw_start(const Case& c, const StartRange& range, std::uint64_t seed, int number,
                      const std::function<bool()>& must_end) {
  Random random(seed, static_cast<std::uint64_t>(number));
  const DraftSpace space = draft_space(c, range);
  FailedAttempts failed;
  while (failed.total() < max_attempts && failed.refused < max_refused && !must_end()) {
    // If a kind finds no room, the next one is tried.
    DrawnStart drawing = attempt(c, range, draft(space, random, number + failed.total() / 20));
    failed += drawing.failed;
    if (drawing.start) return {std::move(drawing.start), std::move(failed)};
  }
  return {{}, std::move(failed)};
}

}  // namespace wheelwright
