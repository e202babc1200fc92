#include "wheelwright/cad/outline/contour_samples.h"

#include <algorithm>
#include <cmath>

namespace wheelwright::cad {
namespace {

/// Angle between the gradients of psi just before and just after a point of the contour.
double kink(const ZeroSet& zero, const Vec<2>& before, const Vec<2>& point, const Vec<2>& after) {
  constexpr double near = 1e-3;
  const Vec<2> a = zero.at(between(point, before, near)).gradient,
               b = zero.at(between(point, after, near)).gradient;
  return std::abs(std::atan2(cross(a, b), dot(a, b)));
}

/// A point between two neighbours of the contour, on the zero set if that is found between them.
Vec<2> point_between(const ZeroSet& zero, const Vec<2>& a, const Vec<2>& b, double t) {
  const Vec<2> chord_point = between(a, b, t);
  const auto projected = zero.projection(chord_point);
  if (!projected || distance(*projected, chord_point) > distance(a, b) / 2) return chord_point;
  return *projected;
}

void add(const Vec<2>& point, double kink, ContourSamples& samples) {
  samples.points.push_back(point);
  samples.kinks.push_back(kink);
}

/// Adds the points between two neighbours of the contour.
void add_between(const Vec<2>& a, const Vec<2>& b, const ZeroSet& zero, double distance,
                 ContourSamples& samples) {
  constexpr int fewest_parts = 4;
  const int parts =
      std::max(fewest_parts, static_cast<int>(std::ceil(wheelwright::distance(b, a) / distance)));
  for (int k = 1; k < parts; ++k) add(point_between(zero, a, b, static_cast<double>(k) / parts), 0, samples);
}

}  // namespace

ContourSamples sample_closed(std::span<const Vec<2>> points, const ZeroSet& zero, double distance) {
  ContourSamples samples;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2>&before = points[(i + n - 1) % n], &after = points[(i + 1) % n];
    add(points[i], kink(zero, before, points[i], after), samples);
    add_between(points[i], after, zero, distance, samples);
  }
  return samples;
}

ContourSamples sample_open(std::span<const Vec<2>> points, const ZeroSet& zero, double distance) {
  ContourSamples samples;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    add(points[i], i == 0 ? 0 : kink(zero, points[i - 1], points[i], points[i + 1]), samples);
    add_between(points[i], points[i + 1], zero, distance, samples);
  }
  add(points.back(), 0, samples);
  return samples;
}

}  // namespace wheelwright::cad
