#include "wheelwright/design/starts/solid_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// The share of a groove in the depth of both grooves together, at the inner and at the outer radius.
struct Share {
  double inner, outer;

  double most() const { return std::max(inner, outer); }
  bool operator==(const Share&) const = default;
};

/// A disc and the grooves beside it.
struct Disc {
  double inner_radius, outer_radius;
  Share smaller_z, larger_z;  ///< the grooves in these sides
};

/// The place where the disc must be, as a fraction of the width. A free disc is in the middle.
double place(const AxialSpace& across) {
  return across.kept ? std::clamp(*across.kept / across.width, 0.0, 1.0) : 0.5;
}

bool is_at_a_side(double place) { return std::min(place, 1 - place) < 1e-9; }

/// The largest depth of both grooves that leaves a wall between them, in which the plane that stays material
/// lies with half of the wall.
double largest_depth(const AxialSpace& across, const Disc& disc) {
  double most = across.width - across.wall;
  if (!across.kept) return most;
  const double margin = is_at_a_side(place(across)) ? 0 : 0.5 * across.wall;
  const auto limit = [&](const Share& share, double room) {
    if (share.most() > 0) most = std::min(most, (room - margin) / share.most());
  };
  limit(disc.smaller_z, *across.kept);
  limit(disc.larger_z, across.width - *across.kept);
  return most;
}

HoleGroove groove(const Disc& disc, const Share& share, GrooveSide side, double size) {
  HoleGroove result{.inner_radius = disc.inner_radius,
                    .outer_radius = disc.outer_radius,
                    .depth = share.inner * size,
                    .side = side};
  if (share.outer != share.inner) result.outer_depth = share.outer * size;
  return result;
}

void draw(const Disc& disc, Case& c, double size) {
  auto& grooves = c.holes.grooves;
  if (disc.smaller_z == disc.larger_z) {
    grooves.push_back(groove(disc, disc.smaller_z, GrooveSide::both, size));
    return;
  }
  if (disc.smaller_z.most() > 0) grooves.push_back(groove(disc, disc.smaller_z, GrooveSide::smaller_z, size));
  if (disc.larger_z.most() > 0) grooves.push_back(groove(disc, disc.larger_z, GrooveSide::larger_z, size));
}

/// In words where the disc lies, by the share of the depth at the side of smaller z.
std::string place_text(double share) {
  if (std::abs(share - 0.5) < 1e-9) return "disc in the middle";
  return fmt::format("disc {} the side at {} z", is_at_a_side(share) ? "at" : "nearer to",
                     share < 0.5 ? "smaller" : "larger");
}

/// The share of the grooves' depth at the side of smaller z, and a text of it.
struct Lie {
  Share smaller_z, larger_z;
  std::string text;
};

Lie lie_at(double share) { return {{share, share}, {1 - share, 1 - share}, place_text(share)}; }

Lie draw_offset(const AxialSpace& across, Random& random) {
  constexpr double at_most = 0.35, at_the_side = 0.12;
  double share = random.uniform(0, at_most);
  const bool mirrored = random.coin();
  if (across.kept) {
    const double there = place(across);
    if (is_at_a_side(there)) return lie_at(there);
    return lie_at(std::clamp(there + (mirrored ? 1 : -1) * (0.5 - share), at_the_side, 1 - at_the_side));
  }
  if (share < at_the_side) share = 0;
  return lie_at(mirrored ? 1 - share : share);
}

std::optional<Lie> draw_leaning(const AxialSpace& across, Random& random) {
  const double there = place(across), lean = random.uniform(0.15, 0.45);
  const bool mirrored = random.coin();
  const double reach = std::min({lean, there - 0.04, 0.96 - there});
  if (reach < 0.1) return {};
  const double inner = there + (mirrored ? reach : -reach), outer = 2 * there - inner;
  return Lie{{inner, outer},
             {1 - inner, 1 - outer},
             fmt::format("disc that leans towards {} z at the tread", mirrored ? "smaller" : "larger")};
}

Lie draw_tapering(const AxialSpace& across, Random& random) {
  const double there = place(across), least = random.uniform(0.3, 0.7);
  const bool thin_at_rim = random.coin();
  const Share along = thin_at_rim ? Share{1, least} : Share{least, 1};
  return {{there * along.inner, there * along.outer},
          {(1 - there) * along.inner, (1 - there) * along.outer},
          fmt::format("{}, thinner at the {}", place_text(there), thin_at_rim ? "rim" : "tread")};
}

std::optional<Lie> draw_lie(const AxialSpace& across, Random& random, DiscKind kind) {
  switch (kind) {
    case DiscKind::middle:
      return lie_at(place(across));
    case DiscKind::offset:
      return draw_offset(across, random);
    case DiscKind::leaning:
      return draw_leaning(across, random);
    case DiscKind::tapering:
      return draw_tapering(across, random);
  }
  return {};
}

}  // namespace

std::optional<Draft> draft_disc(const DraftSpace& space, const AxialSpace& across, Random& random,
                                DiscKind kind) {
  const double room = space.outer - space.inner;
  const double inner = space.inner + random.uniform(0, 0.12) * room,
               outer = space.outer - random.uniform(0, 0.12) * room;
  const auto lie = draw_lie(across, random, kind);
  if (!lie) return {};
  const Disc disc{inner, outer, lie->smaller_z, lie->larger_z};
  const double most = largest_depth(across, disc), minimum = 0.5 * across.wall;
  if (most <= minimum) return {};
  return Draft{.text = lie->text,
               .sectors = across.sectors,
               .minimum = minimum,
               .most = most,
               .draw = [disc](Case& c, double size) { draw(disc, c, size); }};
}

std::optional<Draft> draft_folded_disc(const DraftSpace& space, const AxialSpace& across, Random& random,
                                       int n_grooves) {
  const double room = space.outer - space.inner, wall = random.uniform(1, 1.6) * space.wall;
  const double inner = space.inner + random.uniform(0, 0.08) * room,
               outer = space.outer - random.uniform(0, 0.08) * room;
  const bool mirrored = random.coin();
  const double width = (outer - inner - (n_grooves - 1) * wall) / n_grooves;
  const double minimum = 0.5 * across.width, most = across.width - across.wall;
  if (across.kept || width < space.wall || most <= minimum) return {};
  return Draft{
      .text = fmt::format("disc folded {}", n_grooves == 2   ? std::string("once")
                                            : n_grooves == 3 ? std::string("twice")
                                                             : fmt::format("{} times", n_grooves - 1)),
      .sectors = across.sectors,
      .minimum = minimum,
      .most = most,
      .draw = [=](Case& c, double depth) {
        for (int k = 0; k < n_grooves; ++k) {
          const double from = inner + k * (width + wall);
          const bool is_first_side = (k % 2 == 0) != mirrored;
          c.holes.grooves.push_back({.inner_radius = from,
                                     .outer_radius = from + width,
                                     .depth = depth,
                                     .side = is_first_side ? GrooveSide::smaller_z : GrooveSide::larger_z});
        }
      }};
}

}  // namespace wheelwright
