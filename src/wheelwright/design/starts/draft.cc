#include "wheelwright/design/starts/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wheelwright {
namespace {

using std::numbers::pi;

constexpr int fewest = 6, most = 60;  // holes or spokes round the wheel
constexpr double degree = pi / 180;

/// The number of equal features around the wheel, uniform in its logarithm.
int draw_count(const DraftSpace& space, Random& random, int low, int high) {
  const int s = space.sectors;
  const int fewest_copies = std::max(1, (low + s - 1) / s), max_copies = std::max(fewest_copies, high / s);
  const double copies = random.log_uniform(fewest_copies - 0.5, max_copies + 0.5);
  return s * std::clamp(static_cast<int>(std::lround(copies)), fewest_copies, max_copies);
}

/// A ring of holes of unknown size: its radii are `share` times the size.
struct RingDraft {
  int count;
  double center_radius, phase, share;
};

double distance(const RingDraft& a, double azimuth_a, const RingDraft& b, double azimuth_b) {
  return std::sqrt(a.center_radius * a.center_radius + b.center_radius * b.center_radius -
                   2 * a.center_radius * b.center_radius * std::cos(azimuth_a - azimuth_b));
}

/// The largest size with walls between the holes of two rings.
double room_between(const RingDraft& a, const RingDraft& b, double wall) {
  double nearest = HUGE_VAL;
  for (int i = 0; i < a.count; ++i)
    for (int k = 0; k < b.count; ++k)
      nearest =
          std::min(nearest, distance(a, a.phase + 2 * pi * i / a.count, b, b.phase + 2 * pi * k / b.count));
  return (nearest - wall) / (a.share + b.share);
}

double largest_size(const DraftSpace& space, const std::vector<RingDraft>& rings) {
  double size = HUGE_VAL;
  for (const RingDraft& ring : rings) {
    const double radial = std::min(ring.center_radius - space.inner, space.outer - ring.center_radius);
    const double azimuthal = ring.center_radius * std::sin(pi / ring.count) - 0.5 * space.wall;
    size = std::min(size, std::min(radial, azimuthal) / ring.share);
  }
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t k = i + 1; k < rings.size(); ++k)
      size = std::min(size, room_between(rings[i], rings[k], space.wall));
  return size;
}

std::string rings_text(const std::vector<RingDraft>& rings, bool staggered) {
  if (rings.size() == 1) return fmt::format("ring of {} holes", rings.front().count);
  const bool equal = rings.front().count == rings.back().count;
  const std::string holes = equal ? fmt::format("{} holes", rings.front().count)
                                  : fmt::format("{} and {} holes", rings.front().count, rings.back().count);
  return fmt::format("{} rings of {}{}", rings.size(), holes,
                     !equal      ? ""
                     : staggered ? ", staggered"
                                 : ", aligned");
}

}  // namespace

std::optional<Draft> draft_rings(const DraftSpace& space, Random& random, int n_rings, bool staggered) {
  const int count = draw_count(space, random, fewest, most);
  const bool doubled = n_rings > 1 && !staggered && random.below(4) == 0;  // towards the tread
  const double thickness = (space.outer - space.inner) / n_rings;
  const double ratio =
      n_rings == 1
          ? 1
          : random.uniform(0.85, 1.15);  // of the radii of each ring's holes to those of the ring inside
  std::vector<RingDraft> rings;
  for (int k = 0; k < n_rings; ++k) {
    const int n = doubled && k == n_rings - 1 ? 2 * count : count;
    const double shift = random.uniform(-0.1, 0.1) * thickness;
    rings.push_back({.count = n,
                     .center_radius = space.inner + (k + 0.5) * thickness + shift,
                     .phase = staggered && k % 2 == 1 ? 0 : pi / n,
                     .share = std::pow(ratio, k) * (n == count ? 1 : 0.6)});
  }
  const double largest = largest_size(space, rings);
  if (largest < space.wall) return {};
  return Draft{.text = rings_text(rings, staggered),
               .sectors = count,
               .minimum = 0.5 * space.wall,
               .most = largest,
               .draw = [rings](Case& c, double size) {
                 for (const RingDraft& ring : rings)
                   c.holes.rings.push_back({ring.count, ring.center_radius, ring.share * size, ring.phase});
               }};
}

namespace {

/// How the radius of tapered holes changes along the axle, as a share of the largest.
struct Taper {
  std::vector<std::array<double, 2>> profile;  ///< [z from the middle of the width, share]
  const char* holes;
};

Taper draw_taper(const AxialSpace& across, Random& random, double narrow) {
  const double half = 0.5 * across.width, mean = 0.5 * (1 + narrow);
  const Taper towards_larger{{{-half, 1}, {0, mean}, {half, narrow}}, "holes that narrow towards larger z"},
      towards_smaller{{{-half, narrow}, {0, mean}, {half, 1}}, "holes that narrow towards smaller z"};
  const int form = random.below(4);
  if (across.kept) {
    const double z = *across.kept - half, rounding = 1e-9 * half;
    if (z >= half - rounding) return towards_larger;
    if (z <= rounding - half) return towards_smaller;
    return {{{-half, 1}, {z, narrow}, {half, 1}}, "holes with a waist"};
  }
  switch (form) {
    case 0:
      return towards_larger;
    case 1:
      return towards_smaller;
    case 2:
      return {{{-half, 1}, {0, narrow}, {half, 1}}, "holes with a waist"};
    default:
      return {{{-half, narrow}, {0, 1}, {half, narrow}}, "holes that are widest in the middle"};
  }
}

}  // namespace

std::optional<Draft> draft_tapered_holes(const DraftSpace& space, const AxialSpace& across, Random& random) {
  const int n_rings = 1 + random.below(2);
  const double thickness = (space.outer - space.inner) / n_rings, narrow = random.uniform(0.6, 0.85);
  // As many as have about the same room around the wheel as between rim and tread.
  const double filling = pi * (space.outer + space.inner) / (thickness + space.wall);
  const int count = draw_count(space, random, std::max(fewest, static_cast<int>(0.8 * filling)),
                               std::max(fewest + 1, static_cast<int>(1.2 * filling)));
  std::vector<RingDraft> rings;
  for (int k = 0; k < n_rings; ++k)
    rings.push_back(
        {.count = count,
         .center_radius = space.inner + (k + 0.5) * thickness + random.uniform(-0.05, 0.05) * thickness,
         .phase = k % 2 == 1 ? 0 : pi / count,
         .share = 1});
  const Taper taper = draw_taper(across, random, narrow);
  const double largest = largest_size(space, rings), minimum = 0.5 * space.wall / narrow;
  if (largest <= minimum) return {};
  return Draft{
      .text = n_rings == 1 ? fmt::format("{} {}", count, taper.holes)
                           : fmt::format("2 rings of {} {}", count, taper.holes),
      .sectors = count,
      .minimum = minimum,
      .most = largest,
      .draw = [rings, taper](Case& c, double size) {
        for (const RingDraft& ring : rings) {
          HoleTapered holes{
              .count = ring.count, .center_radius = ring.center_radius, .profile = {}, .phase = ring.phase};
          for (const auto& [z, share] : taper.profile) holes.profile.push_back({z, share * size});
          c.holes.tapered.push_back(std::move(holes));
        }
      }};
}

namespace {

/// Slots or ellipses of one form. The size is their length.
struct LongHoles {
  int count;
  double center_radius, slenderness, angle;

  double width(double length) const { return length / slenderness; }
  /// Half extents along the radius and across it.
  double radial(double length) const { return 0.5 * (along(length, angle)); }
  double azimuthal(double length) const { return 0.5 * along(length, 0.5 * pi - std::abs(angle)); }

 private:
  double along(double length, double turned) const {
    return (length - width(length)) * std::abs(std::cos(turned)) + width(length);
  }
};

std::optional<LongHoles> draft_long_holes(const DraftSpace& space, Random& random, double& largest) {
  const bool tilted = random.below(3) == 0;
  const LongHoles holes{.count = draw_count(space, random, 8, 40),
                        .center_radius = 0.5 * (space.inner + space.outer) +
                                         random.uniform(-0.04, 0.04) * (space.outer - space.inner),
                        .slenderness = random.log_uniform(1.2, 3.5),
                        .angle = tilted ? (random.coin() ? 1 : -1) * random.uniform(15, 50) * degree : 0};
  const auto fits = [&](double length) {
    const double reach = holes.radial(length);
    const double foot = holes.center_radius - (tilted ? 0 : reach - 0.5 * holes.width(length));
    return holes.center_radius - reach >= space.inner && holes.center_radius + reach <= space.outer &&
           holes.azimuthal(length) + 0.5 * space.wall <= foot * std::sin(pi / holes.count);
  };
  largest = space.outer - space.inner;
  while (largest > space.wall && !fits(largest)) largest *= 0.98;
  if (largest <= 2 * space.wall) return {};
  return holes;
}

/// Long holes of one kind of shape.
template <class Shape>
std::optional<Draft> draft_as(std::vector<Shape> Shapes::*shapes, const char* name, const DraftSpace& space,
                              Random& random) {
  double largest = 0;
  const auto holes = draft_long_holes(space, random, largest);
  if (!holes) return {};
  const std::string tilt =
      holes->angle == 0 ? "" : fmt::format(", tilted by {:.0f} deg", holes->angle / degree);
  return Draft{.text = fmt::format("{} {}{}", holes->count, name, tilt),
               .sectors = holes->count,
               .minimum = space.wall,
               .most = largest,
               .draw = [h = *holes, shapes](Case& c, double length) {
                 (c.shapes.*shapes)
                     .push_back({.order = 1,
                                 .count = h.count,
                                 .center_radius = h.center_radius,
                                 .length = length,
                                 .width = h.width(length),
                                 .angle = h.angle});
               }};
}

}  // namespace

std::optional<Draft> draft_slots(const DraftSpace& space, Random& random) {
  return draft_as(&Shapes::slots, "slots", space, random);
}

std::optional<Draft> draft_ellipses(const DraftSpace& space, Random& random) {
  return draft_as(&Shapes::ellipses, "ellipses", space, random);
}

std::optional<Draft> draft_spokes(const DraftSpace& space, Random& random, SpokeKind kind) {
  const int count = draw_count(space, random, fewest, kind == SpokeKind::straight ? 40 : 24);
  const double spacing = 2 * pi / count;
  SpokeShape spoke{.order = 2, .kind = kind, .count = count};
  std::string words;
  switch (kind) {
    case SpokeKind::straight:
      if (random.coin()) spoke.angle = (random.coin() ? 1 : -1) * random.uniform(5, 25) * degree;
      words = spoke.angle == 0 ? "straight spokes" : "inclined spokes";
      break;
    case SpokeKind::curved:
      spoke.bend = (random.coin() ? 1 : -1) * random.uniform(30, 75) * degree;
      words = "curved spokes";
      break;
    case SpokeKind::forked:
      spoke.spread = random.uniform(0.35, 0.65) * spacing;
      words = "forked spokes";
      break;
    case SpokeKind::pair:
      spoke.spread = random.uniform(0.3, 0.7) * spacing;
      spoke.angle = random.uniform(0, 0.5) * spacing;
      words = "pairs of spokes";
      break;
  }
  const double largest = 2 * space.inner * std::sin(0.5 * spacing) - space.wall;
  if (largest <= space.wall) return {};
  return Draft{.text = fmt::format("{} {}", count, words),
               .sectors = count,
               .minimum = space.wall,
               .most = largest,
               .draw = [spoke](Case& c, double thickness) {
                 c.shapes.annuli.push_back({.order = 1});
                 c.shapes.spokes.push_back(spoke);
                 c.shapes.spokes.back().thickness = thickness;
               }};
}

}  // namespace wheelwright
