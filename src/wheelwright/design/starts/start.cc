#include "wheelwright/design/starts/start.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/starts/draft.h"
#include "wheelwright/design/starts/solid_draft.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

constexpr int max_attempts = 200;
/// Refused cases mostly have the same fault, which other holes do not repair.
constexpr int max_refused = 10;
constexpr double volume_tolerance = 1e-3;

/// Rings are the most frequent.
constexpr std::array plane_kinds{StartKind::two_staggered_rings,
                                 StartKind::one_ring,
                                 StartKind::two_rings,
                                 StartKind::plain_spokes,
                                 StartKind::slots,
                                 StartKind::two_staggered_rings,
                                 StartKind::three_staggered_rings,
                                 StartKind::split_spokes,
                                 StartKind::ellipses,
                                 StartKind::three_rings};

/// The kinds of the plane, where one of the others follows every second kind.
std::vector<StartKind> mixed_with_plane_kinds(const std::vector<StartKind>& others) {
  std::vector<StartKind> result;
  for (std::size_t i = 0; i < plane_kinds.size(); ++i) {
    result.push_back(plane_kinds[i]);
    if (i % 2 == 1) result.push_back(others[i / 2 % others.size()]);
  }
  return result;
}

std::optional<Draft> draft(const DraftSpace& space, const AxialSpace& across, Random& random,
                           StartKind kind) {
  switch (kind) {
    case StartKind::one_ring:
      return draft_rings(space, random, 1, false);
    case StartKind::two_rings:
      return draft_rings(space, random, 2, false);
    case StartKind::two_staggered_rings:
      return draft_rings(space, random, 2, true);
    case StartKind::three_rings:
      return draft_rings(space, random, 3, false);
    case StartKind::three_staggered_rings:
      return draft_rings(space, random, 3, true);
    case StartKind::plain_spokes:
      return draft_spokes(space, random, random.coin() ? SpokeKind::straight : SpokeKind::curved);
    case StartKind::split_spokes:
      return draft_spokes(space, random, random.coin() ? SpokeKind::forked : SpokeKind::pair);
    case StartKind::slots:
      return draft_slots(space, random);
    case StartKind::ellipses:
      return draft_ellipses(space, random);
    case StartKind::tapered_holes:
      return draft_tapered_holes(space, across, random);
    case StartKind::middle_disc:
      return draft_disc(space, across, random, DiscKind::middle);
    case StartKind::offset_disc:
      return draft_disc(space, across, random, DiscKind::offset);
    case StartKind::leaning_disc:
      return draft_disc(space, across, random, DiscKind::leaning);
    case StartKind::tapering_disc:
      return draft_disc(space, across, random, DiscKind::tapering);
    case StartKind::disc_folded_once:
      return draft_folded_disc(space, across, random, 2);
    case StartKind::disc_folded_twice:
      return draft_folded_disc(space, across, random, 3);
  }
  return {};
}

constexpr double thinnest = 1.5;  // walls and gaps [cells]

DraftSpace draft_space(const Case& c, const StartRange& range) {
  const auto [inner, outer] = free_region(c);
  const double wall =
      std::max({thinnest * polar_grid<2>(c).resolution(), c.optimizer.minimum_wall.value_or(0),
                c.optimizer.minimum_gap.value_or(0), 2 * c.optimizer.minimum_radius.value_or(0)});
  return {inner, outer, wall, range.keeps_sectors ? c.wheel.sectors : 1};
}

/// The plane in which the holes of a moulded or printed wheel are smallest.
std::optional<double> kept_plane(const Case& c) {
  if (const auto halves = mould(c)) return halves->parting_plane;
  const auto layers = print(c);
  if (!layers) return {};
  return layers->plate == SideFace::smaller_z ? 0 : c.wheel.width;
}

/// Unused in 2D.
AxialSpace axial_space(const Case& c) {
  const double cell = c.wheel.width / c.grid.axial_cells;
  return {c.wheel.width, std::max(thinnest * cell, c.optimizer.minimum_wall.value_or(0)), c.wheel.sectors,
          kept_plane(c)};
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

/// Whether making the shape fit a mould or a print fills, joins or divides holes.
bool is_changed_by_fitting(const Case& c) {
  if (!mould(c) && !print(c)) return false;
  Case free = c;
  free.optimizer.made = Manufacture::free;
  return !topology_changes(components(initial_shape<3>(free)), components(initial_shape<3>(c))).empty();
}

/// One attempt at a start.
DrawnStart attempt(const Case& c, const StartRange& range, const std::optional<Draft>& draft) {
  if (!draft) return {{}, {.without_room = 1}};
  const auto size = matching_size(c, range, *draft);
  if (!size) return {{}, {.off_volume = 1}};
  Case result = drawn(c, range, *draft, *size);
  if (std::string problem = refusal(result); !problem.empty())
    return {{}, {.refused = 1, .refusal = std::move(problem)}};
  if (in_dimension_of(c, [&](auto dim) { return !lost_on_the_grid<dim>(result).empty(); }) ||
      is_changed_by_fitting(result))
    return {{}, {.unresolved = 1}};
  result.title = draft->text;
  return {Start{draft->text, std::move(result)}, {}};
}

}  // namespace

std::vector<StartKind> kinds_of_starts(const Case& c) {
  using enum StartKind;
  const std::vector of_the_plane(plane_kinds.begin(), plane_kinds.end());
  if (c.wheel.dimension != 3) return of_the_plane;
  switch (c.optimizer.made) {
    case Manufacture::extruded:
      return of_the_plane;
    case Manufacture::turned:
      return {middle_disc, leaning_disc, offset_disc, disc_folded_once, tapering_disc, disc_folded_twice};
    case Manufacture::moulded:
      return mixed_with_plane_kinds({middle_disc, tapered_holes, offset_disc, leaning_disc, tapering_disc});
    case Manufacture::printed:
      return mixed_with_plane_kinds({middle_disc, tapered_holes, tapering_disc});
    case Manufacture::free:
      break;
  }
  return mixed_with_plane_kinds({middle_disc, tapered_holes, leaning_disc, disc_folded_once, offset_disc});
}

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
  const AxialSpace across = axial_space(c);
  const std::vector<StartKind> kinds = kinds_of_starts(c);
  FailedAttempts failed;
  while (failed.total() < max_attempts && failed.refused < max_refused && !must_end()) {
    // If a kind finds no room, the next one is tried.
    const StartKind kind = kinds[(number + failed.total() / 20) % kinds.size()];
    DrawnStart drawing = attempt(c, range, draft(space, across, random, kind));
    failed += drawing.failed;
    if (drawing.start) return {std::move(drawing.start), std::move(failed)};
  }
  return {{}, std::move(failed)};
}

}  // namespace wheelwright
