#include "wheelwright/cad/outline/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/fit_loop.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright::cad {
namespace {

/// A free part of a contour and its curves.
struct FittedPart {
  std::vector<Vec<2>> points;
  std::vector<Curve> curves;
};

/// Fits the free parts of the contours of a section.
class PartFitter {
 public:
  PartFitter(const TurnedSection& section, double tolerance) : section_(section), tolerance_(tolerance) {}

  /// The curves through points on the zero set: from the first to the last, or around a whole contour.
  Expected<std::vector<Curve>, NoFit> curves(const std::vector<Vec<2>>& points, bool is_closed) {
    for (const FittedPart& other : parts_)
      if (is_mirror_image(points, other.points, is_closed)) return images(other.curves);
    const double distance = sample_distance * tolerance_;
    auto curves = is_closed ? fit_loop(sample_closed(points, section_, distance), tolerance_)
                            : fit_chain(sample_open(points, section_, distance), tolerance_);
    if (curves) parts_.push_back({points, *curves});
    return curves;
  }

 private:
  Vec<2> image(const Vec<2>& p) const { return {section_.width() - p[0], p[1]}; }

  /// Whether points are the images of others in the opposite order; those of closed contours begin anywhere.
  bool is_mirror_image(const std::vector<Vec<2>>& points, const std::vector<Vec<2>>& others,
                       bool is_closed) const {
    const double slack = 1e-9 * section_.outer_radius();
    const std::size_t n = points.size();
    if (others.size() != n) return false;
    const Vec<2> start = image(points.front());
    std::size_t first = n - 1;
    if (is_closed)
      first = std::ranges::min_element(others, {},
                                       [&](const Vec<2>& p) { return wheelwright::distance(p, start); }) -
              others.begin();
    for (std::size_t i = 0; i < n; ++i)
      if (!(wheelwright::distance(image(points[i]), others[(first + n - i) % n]) < slack)) return false;
    return true;
  }

  std::vector<Curve> images(const std::vector<Curve>& curves) const {
    std::vector<Curve> result;
    for (const Curve& curve : curves) result.push_back(reversed(mirrored(curve, section_.width() / 2)));
    std::ranges::reverse(result);
    return result;
  }

  const TurnedSection& section_;
  double tolerance_;
  std::vector<FittedPart> parts_;
};

/// The curves of a whole contour. One with sides begins with one.
Expected<std::vector<Curve>, NoFit> curves_of(const SectionContour& contour, PartFitter& fitter) {
  const auto& corners = contour.corners;
  std::vector<Vec<2>> part;
  if (corners.front().side == SectionSide::free) {
    for (const auto& corner : corners) part.push_back(corner.point);
    return fitter.curves(part, true);
  }
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>&from = corners[i].point, &to = corners[(i + 1) % corners.size()].point;
    const bool ends = corners[(i + 1) % corners.size()].side != SectionSide::free;
    if (corners[i].side != SectionSide::free) {
      curves.push_back(Line{from, to});
      continue;
    }
    part.push_back(from);
    if (!ends) continue;
    part.push_back(to);
    auto of_part = fitter.curves(part, false);
    if (!of_part) return of_part.failure();
    std::ranges::move(*of_part, std::back_inserter(curves));
    part.clear();
  }
  return curves;
}

LoopKind kind_of(const std::vector<Curve>& curves, bool is_first) {
  if (signed_area({LoopKind::hole, curves}) < 0) return LoopKind::hole;
  return is_first ? LoopKind::outer_edge : LoopKind::island;
}

/// The integral of y^2 / 2 dx along a curve [m^3].
double moment_under(const Curve& curve) {
  if (const auto* arc = std::get_if<Arc>(&curve)) {
    const auto antiderivative = [&](double a) {
      const double c = std::cos(a), y = arc->centre[1], r = arc->radius;
      // of (y + r sin)^2 sin
      return -y * y * c + y * r * (a - std::sin(a) * c) + r * r * (c * c * c / 3 - c);
    };
    return -0.5 * arc->radius * (antiderivative(arc->begin + arc->sweep) - antiderivative(arc->begin));
  }
  static constexpr int points = 5;  // the integrand has degree 8
  double sum = 0;
  for (const Bezier& piece : beziers(curve, 0)) {
    const GaussRule rule = gauss_rule(points);
    for (int i = 0; i < points; ++i) {
      const auto [position, velocity] = wheelwright::at(piece, rule.points[i]);
      sum += 0.5 * rule.weights[i] * position[1] * position[1] * velocity[0];
    }
  }
  return sum;
}

}  // namespace

Expected<Outline, OutlineFault> fit_profile(const TurnedSection& section, double tolerance) {
  PartFitter fitter(section, tolerance);
  Outline profile;
  for (const SectionContour& contour : material_contours(section, contour_subdivisions(section.degree()))) {
    auto curves = curves_of(contour, fitter);
    if (!curves)
      return OutlineFault{fmt::format(
          "no curve follows the contour within {:.3g} mm at {}; the deviation is {:.3g} mm", tolerance * 1e3,
          place_in_section(curves.failure().place), curves.failure().deviation * 1e3)};
    profile.loops.push_back({LoopKind::hole, *std::move(curves)});
  }
  if (profile.loops.empty()) return OutlineFault{"there is no material"};
  bool is_first = true;
  for (Loop& loop : profile.loops) {
    loop.kind = kind_of(loop.curves, is_first);
    if (loop.kind == LoopKind::outer_edge) is_first = false;
  }
  std::ranges::stable_sort(profile.loops, {}, &Loop::kind);
  return profile;
}

double volume_of_revolution(const Outline& profile) {
  double sum = 0;
  for (const Loop& loop : profile.loops)
    for (const Curve& curve : loop.curves) sum -= moment_under(curve);
  return 2 * std::numbers::pi * sum;
}

std::string place_in_section(const Vec<2>& point) {
  return fmt::format("radius {:.1f} mm, z = {:.1f} mm", point[1] * 1e3, point[0] * 1e3);
}

}  // namespace wheelwright::cad
