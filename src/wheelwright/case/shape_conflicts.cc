#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/load_drawings.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/shape_symmetry.h"

namespace wheelwright {

namespace {

std::string point_text(const Point& p) { return fmt::format("[{:.6g}, {:.6g}] m", p[0], p[1]); }

/// ", of line 12, <path>" if the place in the drawing is known.
std::string place_text(const std::string& place) { return place.empty() ? "" : fmt::format(" ({})", place); }

void check_slots(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.shapes.slots.size(); ++i)
    if (const SlotShape& slot = c.shapes.slots[i]; slot.width > slot.length)
      found.push_back(
          {{key_of(&SlotShape::width, i), key_of(&SlotShape::length, i)},
           fmt::format("wider than its length of {:.6g} m", slot.length),
           "the length is measured from end to end, with the round ends; or turn the slot with `angle`"});
}

void check_annuli(const Case& c, Conflicts& found) {
  const auto [low, high] = free_region(c);
  for (std::size_t i = 0; i < c.shapes.annuli.size(); ++i) {
    const AnnulusShape& annulus = c.shapes.annuli[i];
    const double inner = annulus.inner_radius.value_or(low), outer = annulus.outer_radius.value_or(high);
    if (low >= high || inner < outer) continue;
    found.push_back(
        {with_ring_shape({key_of(&AnnulusShape::inner_radius, i), key_of(&AnnulusShape::outer_radius, i)}),
         fmt::format("the annulus starts at {:.6g} m and ends at {:.6g} m", inner, outer),
         "set inner_radius < outer_radius"});
  }
}

/// Keys that do not apply to the kind of a spoke.
void check_kind_of_spoke(const SpokeShape& s, std::size_t i, Conflicts& found) {
  const auto refuse = [&](bool is_wrong, const CaseKey& key, std::string problem, std::string remedy) {
    if (is_wrong)
      found.push_back({{key, key_of(&SpokeShape::kind, i)}, std::move(problem), std::move(remedy)});
  };
  const bool curved = s.kind == SpokeKind::curved, forked = s.kind == SpokeKind::forked,
             pair = s.kind == SpokeKind::pair;
  refuse(curved && s.bend == 0, key_of(&SpokeShape::bend, i), "a curved spoke without bend is straight",
         "set its bend, e.g. 60");
  refuse(!curved && s.bend != 0, key_of(&SpokeShape::bend, i), "only curved spokes bend",
         "use kind = \"curved\", or omit the key");
  refuse(forked && s.spread == 0, key_of(&SpokeShape::spread, i), "the branches of the fork coincide",
         "set a spread > 0");
  refuse(!forked && !pair && s.spread != 0, key_of(&SpokeShape::spread, i),
         "only forked spokes and pairs have a spread", "use another kind, or omit the key");
  refuse(!forked && s.fork_radius, key_of(&SpokeShape::fork_radius, i), "only forked spokes divide",
         "use kind = \"forked\", or omit the key");
  refuse(pair && s.spread == 0 && s.angle == 0, key_of(&SpokeShape::angle, i),
         "the two spokes of the pair coincide", "set an angle or a spread");
}

void check_spoke(const Case& c, std::size_t i, Conflicts& found) {
  const SpokeShape& s = c.shapes.spokes[i];
  check_kind_of_spoke(s, i, found);
  const double inner = s.inner_radius.value_or(c.wheel.inner_radius),
               outer = s.outer_radius.value_or(c.wheel.outer_radius);
  const CaseKeys ends{key_of(&SpokeShape::inner_radius, i), key_of(&SpokeShape::outer_radius, i),
                      key_of(&Wheel::inner_radius), key_of(&Wheel::outer_radius)};
  if (c.wheel.inner_radius >= c.wheel.outer_radius) return;
  if (inner >= outer) {
    found.push_back({ends, fmt::format("the spoke starts at {:.6g} m and ends at {:.6g} m", inner, outer),
                     "set inner_radius < outer_radius"});
    return;
  }
  if (s.thickness >= outer - inner)
    found.push_back({{key_of(&SpokeShape::thickness, i), ends[0], ends[1], ends[2], ends[3]},
                     fmt::format("thicker than the spoke is long, {:.6g} m", outer - inner),
                     "use thinner spokes"});
  if (s.fork_radius && (*s.fork_radius <= inner || *s.fork_radius >= outer))
    found.push_back({{key_of(&SpokeShape::fork_radius, i), ends[0], ends[1], ends[2], ends[3]},
                     fmt::format("not between the ends of the spoke, at {:.6g} m and {:.6g} m", inner, outer),
                     "use a radius between them"});
  const double chord = std::sqrt(inner * inner + outer * outer - 2 * inner * outer * std::cos(s.angle));
  const double radius = s.bend == 0 ? HUGE_VAL : 0.5 * chord / std::abs(std::sin(0.5 * s.bend));
  if (s.kind == SpokeKind::curved && (std::abs(s.bend) > std::numbers::pi || radius <= s.thickness))
    found.push_back(
        {{key_of(&SpokeShape::bend, i), key_of(&SpokeShape::thickness, i), key_of(&SpokeShape::angle, i)},
         "bent so much that the spoke intersects itself",
         "use a bend between -180 and 180, or thinner spokes"});
}

/// The innermost and outermost points of an outline.
RadialExtent radial_extent(const DrawnShape& shape, std::string& lowest_place, std::string& highest_place) {
  RadialExtent all{HUGE_VAL, 0, {}, {}};
  for (const DrawnOutline& outline : shape.first)
    for (const DrawnLoop& loop : outline.loops)
      for (const Curve& curve : loop.curves) {
        const RadialExtent extent = radial_extent(curve);
        if (extent.low < all.low) all.low = extent.low, all.lowest = extent.lowest, lowest_place = loop.place;
        if (extent.high > all.high)
          all.high = extent.high, all.highest = extent.highest, highest_place = loop.place;
      }
  return all;
}

/// The file of curves that a shape comes from; null for others, and without a drawing.
const FileShape* file_of(const DrawnShape& shape, const Case& c) {
  for (std::size_t i = 0; i < c.shapes.files.size(); ++i)
    if (shape.table == table_of<FileShape>(i) && c.shapes.files[i].drawing.contents)
      return &c.shapes.files[i];
  return nullptr;
}

/// Whether the radii of the wheel are too large to be in metres.
bool is_huge(const Wheel& wheel) {
  constexpr double largest_radius = 5;
  return wheel.outer_radius > largest_radius;
}

/// The units with which a drawing would end in the ring, if it does not; empty if it is the wheel whose size
/// is doubtful.
std::string unit_hint(const DrawnShape& shape, const Case& c, double reach) {
  struct NamedUnit {
    DrawingUnit unit;
    std::string_view word, key;
  };
  constexpr std::array<NamedUnit, 4> units{{{DrawingUnit::metre, "metres", "m"},
                                            {DrawingUnit::centimetre, "centimetres", "cm"},
                                            {DrawingUnit::millimetre, "millimetres", "mm"},
                                            {DrawingUnit::inch, "inches", "in"}}};
  constexpr double near = 1.01;
  const auto ends_in_ring = [&](double radius) {
    return radius > c.wheel.inner_radius && radius <= near * c.wheel.outer_radius;
  };
  const FileShape* file = file_of(shape, c);
  if (!file || ends_in_ring(reach) || is_huge(c.wheel)) return "";
  std::vector<std::string_view> words;
  std::vector<std::string> remedies;
  for (const auto& [unit, word, key] : units) {
    if (!ends_in_ring(reach / file->drawing.contents->metres_per_unit * *metres(unit))) continue;
    words.push_back(word);
    remedies.push_back(fmt::format("set unit = \"{}\"", key));
  }
  if (words.empty()) return "";
  return fmt::format("it fits if its numbers are in {}: {}", fmt::join(words, " or "),
                     file->unit == DrawingUnit::of_file ? "correct the unit that the file states"
                                                        : fmt::format("{}", fmt::join(remedies, " or ")));
}

/// How much larger or smaller a drawing must be for the region; empty if no size fits.
std::string scale_hint(const DrawnShape& shape, const Case& c, const RadialExtent& extent,
                       const HoleRange& region) {
  if (!file_of(shape, c) || is_huge(c.wheel) || !(extent.low > 0)) return "";
  const double least = rounded_up(region.inner / extent.low),
               most = 1 / rounded_up(extent.high / region.outer);
  if (least > most) return "";
  return fmt::format("it fits if it is drawn {:.3g} to {:.3g} times as large", least, most);
}

/// Advice for a drawing of holes that extends to the tread, and may show the material.
std::string whole_wheel_hint(const DrawnShape& shape, const Case& c, double reach) {
  constexpr double near = 0.01;
  const bool shows_tread = std::abs(reach - c.wheel.outer_radius) < near * c.wheel.outer_radius;
  if (!file_of(shape, c) || shape.fill != Fill::hole || !shows_tread) return "";
  return "if it shows the whole wheel with its tread, put [[shape.annulus]] before it and set as = "
         "\"material\"";
}

/// Holes must lie between the bands, and material in the ring.
void check_extent(const Case& c, const DrawnShape& shape, Conflicts& found) {
  const bool is_hole = shape.fill == Fill::hole;
  const HoleRange room = room_for_holes(c);
  if (room.inner >= room.outer || shape.first.empty() || (!is_hole && shape.may_leave_ring)) return;
  const HoleRange region = is_hole ? room : HoleRange{c.wheel.inner_radius, c.wheel.outer_radius};
  std::string lowest_place, highest_place;
  const RadialExtent extent = radial_extent(shape, lowest_place, highest_place);
  const double rounding = 1e-5 * c.wheel.outer_radius;
  const bool is_low = extent.low<region.inner - rounding, is_high = extent.high> region.outer + rounding;
  if (!is_low && !is_high) return;
  const std::string where = is_high ? fmt::format("reaches radius {:.6g} m at {}{}", extent.high,
                                                  point_text(extent.highest), place_text(highest_place))
                                    : fmt::format("reaches radius {:.6g} m at {}{}", extent.low,
                                                  point_text(extent.lowest), place_text(lowest_place));
  std::string hint = unit_hint(shape, c, extent.high);
  if (hint.empty()) hint = whole_wheel_hint(shape, c, extent.high);
  if (hint.empty()) hint = scale_hint(shape, c, extent, region);
  if (hint.empty()) hint = "move it, or make it smaller";
  if (is_huge(c.wheel)) hint += if_in_millimetres(c.wheel.outer_radius, 2 * extent.high);
  const std::string allowed =
      is_hole ? "between the bands at rim and tread there is only" : "the ring has only";
  found.push_back({with_ring_shape({shape.table}),
                   fmt::format("{} {}; {} {:.6g} m to {:.6g} m", is_hole ? "the hole" : "the material", where,
                               allowed, region.inner, region.outer),
                   hint});
}

void check_crossings(const DrawnShape& shape, Conflicts& found) {
  constexpr int most = 3;
  for (const DrawnOutline& outline : shape.first)
    for (const Crossing& crossing : crossings(outline, most))
      found.push_back({{shape.table},
                       fmt::format("the outline crosses or touches itself at {}{}", point_text(crossing.at),
                                   place_text(crossing.first)),
                       "correct its points"});
}

void check_pictures(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.shapes.pictures.size(); ++i) {
    const PictureShape& picture = c.shapes.pictures[i];
    const bool is_wheel = picture.layout == PictureLayout::wheel;
    if (is_wheel == picture.width.has_value()) continue;
    found.push_back({{key_of(&PictureShape::width, i), table_of<PictureShape>(i)},
                     is_wheel ? "missing: a picture has no scale"
                              : "the picture of a sector needs no width: it is as wide as the sector",
                     is_wheel ? "set the width of the whole picture in metres" : "omit the key"});
  }
}

/// Finds drawings and pictures that are not the same in all sectors.
void check_repetition(const Case& c, const std::vector<DrawnShape>& shapes, const DrawnShape& shape,
                      Conflicts& found) {
  const int sectors = c.wheel.sectors;
  if (shape.repetition != Repetition::by_curves || shape.count % sectors == 0 || shape.first.empty()) return;
  const Composition drawn = outlines_of(c, shape);
  if (repeats(drawn, sectors, accepted_asymmetry(c, shape))) return;
  const Asymmetry most = asymmetry(drawn, sectors, c.wheel.outer_radius);
  const std::vector<int> fitting = fitting_sectors(c, shapes);
  std::string problem = fmt::format(
      "what {} draws is not the same in {} sectors: turned by {:.6g} degrees it differs by up to {:.3g} mm, "
      "at "
      "{}",
      shape.table.path(), sectors, 360.0 / sectors, most.distance * 1e3, point_text(most.at));
  if (most_sectors_of(c, shape) == 1) {
    if (const auto near = nearly_fitting(c, shape))
      problem +=
          fmt::format("; with {} sectors it would differ by {:.3g} mm", near->sectors, near->distance * 1e3);
    if (shape.count == 1)
      problem += fmt::format("; if it shows one of {} equal parts, give count = {}", sectors, sectors);
  }
  found.push_back(
      {{key_of(&Wheel::sectors), shape.path_key, shape.table},
       std::move(problem),
       fmt::format("values of wheel.sectors that fit all rings and shapes: {}", fmt::join(fitting, ", "))});
}

void check_number_of_curves(const std::vector<DrawnShape>& shapes, Conflicts& found) {
  long long total = 0;
  for (const DrawnShape& shape : shapes) {
    total += curve_count(shape);
    if (total <= most_curves) continue;
    found.push_back({{shape.table},
                     fmt::format("the shapes up to this one have {} curves around the wheel", total),
                     fmt::format("at most {} are accepted; simplify the drawing", most_curves)});
    return;
  }
}

/// Finds shapes that draw only material where there are no holes: the wheel would start as a full ring.
void check_material_on_the_ring(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  const auto is_hole = [](const DrawnShape& shape) { return shape.fill == Fill::hole; };
  if (shapes.empty() || c.holes != Holes{} || std::ranges::any_of(shapes, is_hole)) return;
  found.push_back({{shapes.front().table},
                   "it draws material on a full ring, so nothing is cut out of it",
                   "put [[shape.annulus]] before it, or set as = \"hole\""});
}

}  // namespace

void shape_conflicts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  Conflicts of_keys;
  check_slots(c, of_keys);
  check_annuli(c, of_keys);
  for (std::size_t i = 0; i < c.shapes.spokes.size(); ++i) check_spoke(c, i, of_keys);
  check_pictures(c, of_keys);
  check_number_of_curves(shapes, of_keys);
  found.insert(found.end(), of_keys.begin(), of_keys.end());
  if (!of_keys.empty()) return;
  for (const DrawnShape& shape : shapes) {
    check_extent(c, shape, found);
    if (shape.repetition == Repetition::by_count) check_crossings(shape, found);
    check_repetition(c, shapes, shape, found);
  }
  check_material_on_the_ring(c, shapes, found);
}

}  // namespace wheelwright
