#include "wheelwright/cad/outline/contour_samples.h"

#include <algorithm>
#include <cmath>

namespace wheelwright::cad {
namespace {

/// Angle between the gradients of psi just before and just after a point of the contour.
double kink(const ZeroContour& zero, const Vec<2>& before, const Vec<2>& point, const Vec<2>& after) {
  constexpr double near = 1e-3;
  const Vec<2> a = zero.at(between(point, before, near)).gradient,
               b = zero.at(between(point, after, near)).gradient;
  return std::abs(std::atan2(cross(a, b), dot(a, b)));
}

/// A point between two neighbours of the contour, on the zero contour if that is found between them.
Vec<2> point_between(const ZeroContour& zero, const Vec<2>& a, const Vec<2>& b, double t) {
  const Vec<2> chord_point = between(a, b, t);
  const auto projected = zero.projection(chord_point);
  if (!projected || distance(*projected, chord_point) > distance(a, b) / 2) return chord_point;
  return *projected;
}

}  // namespace

ContourSamples sample(const Contour& contour, const ZeroContour& zero, double distance) {
  constexpr int fewest_parts = 4;
  ContourSamples samples;
  const auto& p = contour.points;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2>&before = p[(i + n - 1) % n], &after = p[(i + 1) % n];
    const double length = wheelwright::distance(after, p[i]);
    const int parts = std::max(fewest_parts, static_cast<int>(std::ceil(length / distance)));
    samples.points.push_back(p[i]);
    samples.kinks.push_back(kink(zero, before, p[i], after));
    for (int k = 1; k < parts; ++k) {
      samples.points.push_back(point_between(zero, p[i], after, static_cast<double>(k) / parts));
      samples.kinks.push_back(0);
    }
  }
  return samples;
}

}  // namespace wheelwright::cad
