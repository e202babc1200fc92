#include "wheelwright/case/drawn_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/cad/drawing/picture_outline.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/keys.h"

namespace wheelwright {

namespace {

using std::numbers::pi;
using Outlines = std::vector<DrawnOutline>;

double first_azimuth(const std::optional<double>& phase, int count) { return phase.value_or(pi / count); }

// One function per kind of shape: the outlines of the first one.

Outlines outlines(const CircleShape& s, const Case&) {
  return {circle_outline(polar_frame(s.center_radius, first_azimuth(s.phase, s.count), 0), s.radius)};
}

Outlines outlines(const EllipseShape& s, const Case&) {
  const Affine frame = polar_frame(s.center_radius, first_azimuth(s.phase, s.count), s.angle);
  return {ellipse_outline(frame, s.length, s.width)};
}

Outlines outlines(const SlotShape& s, const Case&) {
  const Affine frame = polar_frame(s.center_radius, first_azimuth(s.phase, s.count), s.angle);
  return {slot_outline(frame, s.length, s.width)};
}

Outlines outlines(const PolygonShape& s, const Case&) {
  return {polygon_outline(s.points).mapped(Affine::rotation(s.phase))};
}

Outlines outlines(const AnnulusShape& s, const Case& c) {
  const auto [low, high] = free_region(c);
  return {annulus_outline(s.inner_radius.value_or(low), s.outer_radius.value_or(high))};
}

/// A strip that continues beyond ends that are not given, so that it meets rim and tread over its whole
/// thickness.
DrawnOutline spoke_strip(const SpokeShape& s, Point from, Point to, double bend) {
  const Point chord = to - from;
  const double length = norm<2>(chord), beyond = s.thickness;
  const Affine turned = Affine::rotation(0.5 * bend);
  const Affine back = Affine::rotation(-0.5 * bend);
  // The angle by which a curved strip turns in its continuation.
  const double further =
      bend == 0 ? 0 : 2 * std::asin(std::min(1.0, std::abs(beyond / length * std::sin(0.5 * bend))));
  const double sign = bend < 0 ? -1 : 1, half = 0.5 * sign * further;
  const Point at_start = beyond / length * Affine::rotation(-half).linear(back.linear(chord));
  const Point on_end = beyond / length * Affine::rotation(half).linear(turned.linear(chord));
  if (!s.inner_radius) from = from - at_start;
  if (!s.outer_radius) to = to + on_end;
  return strip_outline(from, to, s.thickness, bend + sign * further * (!s.inner_radius + !s.outer_radius));
}

Outlines forked_spoke(const SpokeShape& s, const Point& foot, double outer, double end_azimuth, double fork) {
  const Point middle = polar(outer, end_azimuth);
  // The stem points midway between the ends of the branches.
  const double reach = (fork - norm<2>(foot)) / (outer - norm<2>(foot));
  const Point joint = foot + reach * (middle - foot);
  SpokeShape stem = s, branch = s;
  stem.outer_radius = branch.inner_radius = fork;
  return {spoke_strip(stem, foot, joint, 0), circle_outline(Affine::shift(joint), 0.5 * s.thickness),
          spoke_strip(branch, joint, polar(outer, end_azimuth - 0.5 * s.spread), 0),
          spoke_strip(branch, joint, polar(outer, end_azimuth + 0.5 * s.spread), 0)};
}

Outlines outlines(const SpokeShape& s, const Case& c) {
  const double inner = s.inner_radius.value_or(c.wheel.inner_radius),
               outer = s.outer_radius.value_or(c.wheel.outer_radius);
  const double azimuth = first_azimuth(s.phase, s.count), half_spread = 0.5 * s.spread;
  const Point foot = polar(inner, azimuth);
  switch (s.kind) {
    case SpokeKind::straight:
    case SpokeKind::curved:
      return {
          spoke_strip(s, foot, polar(outer, azimuth + s.angle), s.kind == SpokeKind::curved ? s.bend : 0)};
    case SpokeKind::forked:
      return forked_spoke(s, foot, outer, azimuth + s.angle, s.fork_radius.value_or(0.5 * (inner + outer)));
    case SpokeKind::pair:
      return {spoke_strip(s, polar(inner, azimuth - half_spread),
                          polar(outer, azimuth - half_spread + s.angle), 0),
              spoke_strip(s, polar(inner, azimuth + half_spread),
                          polar(outer, azimuth + half_spread - s.angle), 0)};
  }
  return {};
}

Outlines outlines(const FileShape& s, const Case&) {
  if (!s.drawing.contents) return {};
  return {s.drawing.contents->outline.mapped(Affine::rotation(s.phase))};
}

Outlines outlines(const PictureShape& s, const Case& c) {
  if (!s.picture.contents) return {};
  const Picture& picture = *s.picture.contents;
  const DrawnOutline outline =
      s.layout == PictureLayout::wheel
          ? wheel_outline(picture, s.threshold, s.width.value_or(0))
          : ring_outline(picture, s.threshold, s.count, c.wheel.inner_radius, c.wheel.outer_radius);
  return {outline.mapped(Affine::rotation(s.phase))};
}

/// Arc length at the tread shown by the picture of a sector [m].
double sector_width(const PictureShape& s, const Case& c) { return 2 * pi * c.wheel.outer_radius / s.count; }

/// The accuracy of a shape's curves [m].
template <class Shape>
double accuracy(const Shape& shape, const Case& c) {
  constexpr double of_drawings = 1e-4;
  const double least = of_drawings * c.wheel.outer_radius;
  if constexpr (std::is_same_v<Shape, PictureShape>) {
    if (!shape.picture.contents) return least;
    const double width =
        shape.layout == PictureLayout::wheel ? shape.width.value_or(0) : sector_width(shape, c);
    return std::max(least, width / shape.picture.contents->columns);
  }
  return least;
}

bool is_possible(const CircleShape&, const Case&) { return true; }
bool is_possible(const EllipseShape&, const Case&) { return true; }
bool is_possible(const SlotShape& s, const Case&) { return s.width <= s.length; }
bool is_possible(const PolygonShape& s, const Case&) { return s.points.size() >= fewest_points; }
bool is_possible(const AnnulusShape& s, const Case& c) {
  const auto [low, high] = free_region(c);
  return s.inner_radius.value_or(low) < s.outer_radius.value_or(high);
}
bool is_possible(const SpokeShape& s, const Case& c) {
  const double inner = s.inner_radius.value_or(c.wheel.inner_radius),
               outer = s.outer_radius.value_or(c.wheel.outer_radius);
  const double fork = s.fork_radius.value_or(0.5 * (inner + outer));
  return inner < outer && s.thickness < outer - inner && fork > inner && fork < outer;
}

bool is_possible(const FileShape&, const Case&) { return true; }
bool is_possible(const PictureShape& s, const Case&) { return s.layout == PictureLayout::sector || s.width; }

template <class Shape>
int copies(const Shape& shape) {
  if constexpr (requires { shape.count; })
    return shape.count;
  else
    return 1;
}

template <class Shape>
constexpr Repetition repetition = Repetition::by_count;
template <>
constexpr Repetition repetition<AnnulusShape> = Repetition::round;
template <>
constexpr Repetition repetition<FileShape> = Repetition::by_curves;
template <>
constexpr Repetition repetition<PictureShape> = Repetition::by_curves;

/// The picture of a sector is drawn around the whole wheel at once, because its outlines cross the faces of
/// sectors.
template <class Shape>
bool is_whole(const Shape& shape) {
  if constexpr (std::is_same_v<Shape, PictureShape>)
    return shape.layout == PictureLayout::sector;
  else
    return false;
}

Outlines turned(const Outlines& first, double angle) {
  const Affine turn = Affine::rotation(angle);
  Outlines result;
  for (const DrawnOutline& outline : first) result.push_back(outline.mapped(turn));
  return result;
}

template <class Shape>
CaseKey count_key(std::size_t i) {
  if constexpr (requires { &Shape::count; })
    return key_of(&Shape::count, i);
  else
    return {};
}

template <class Shape>
CaseKey path_key(std::size_t i) {
  if constexpr (requires { &Shape::path; })
    return key_of(&Shape::path, i);
  else
    return {};
}

/// The `[[holes.*]]` of all sectors.
Figure holes_figure(const Case& c) {
  Figure figure{Fill::hole, {}};
  for (const Circle& hole : sector_holes(c))
    for (int sector = 0; sector < c.wheel.sectors; ++sector) {
      const double azimuth = hole.centre_azimuth + sector * sector_angle(c);
      figure.outlines.push_back(
          circle_outline(polar_frame(hole.centre_radius, azimuth, 0), hole.hole_radius));
    }
  return figure;
}

}  // namespace

std::vector<DrawnShape> drawn_shapes(const Case& c) {
  std::vector<DrawnShape> result;
  for_each_shape_section([&](const auto& section) {
    std::size_t i = 0;
    for (const auto& shape : section.of(c)) {
      using Shape = std::decay_t<decltype(shape)>;
      const bool has_outlines = copies(shape) > 0 && is_possible(shape, c);
      result.push_back(
          {.order = shape.order,
           .table = table_of<Shape>(i),
           .count_key = count_key<Shape>(i),
           .path_key = path_key<Shape>(i),
           .fill = shape.as,
           .first = has_outlines ? outlines(shape, c) : Outlines{},
           .repetition = repetition<Shape>,
           .count = is_whole(shape) ? 1 : copies(shape),
           .may_leave_ring = std::is_same_v<Shape, SpokeShape> || std::is_same_v<Shape, PictureShape>,
           .accuracy = accuracy(shape, c)});
      ++i;
    }
  });
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.order < b.order; });
  return result;
}

Figure figure_of(const DrawnShape& shape) {
  Figure figure{shape.fill, shape.first};
  for (int i = 1; i < shape.count; ++i)
    for (DrawnOutline& outline : turned(shape.first, 2 * pi * i / shape.count))
      figure.outlines.push_back(std::move(outline));
  return figure;
}

std::vector<Figure> figures(const Case& c) {
  std::vector<Figure> result{holes_figure(c)};
  for (const DrawnShape& shape : drawn_shapes(c)) result.push_back(figure_of(shape));
  return result;
}

long long curve_count(const DrawnShape& shape) {
  long long count = 0;
  for (const DrawnOutline& outline : shape.first)
    for (const DrawnLoop& loop : outline.loops) count += static_cast<long long>(loop.curves.size());
  return count * shape.count;
}

}  // namespace wheelwright
