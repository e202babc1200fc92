#include "wheelwright/cad/outline/fit_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/circle_fit.h"

namespace wheelwright::cad {
namespace {

/// Fraction of the tolerance for the fit at the samples; the rest is for the curve between them.
constexpr double share_of_fit = 0.8;
/// A kink is a corner from this angle on [rad]. Polynomials of neighbouring cells meet at smaller angles
/// everywhere; the spline rounds them.
constexpr double corner_angle = 20 * std::numbers::pi / 180;
/// A kink of this angle also becomes a corner if no spline follows the contour otherwise [rad].
constexpr double least_corner_angle = std::numbers::pi / 180;

Expected<Curve, NoFit> fit_open(std::span<const Vec<2>> points, double tolerance) {
  if (const auto line = fit_line(points, tolerance)) return Curve(*line);
  if (const auto arc = fit_arc(points, tolerance)) return Curve(*arc);
  auto spline = fit_spline(points, false, tolerance);
  if (!spline) return spline.failure();
  return Curve(*std::move(spline));
}

Expected<Curve, NoFit> fit_closed(std::span<const Vec<2>> points, double tolerance) {
  if (const auto circle = fit_circle(points, tolerance)) return Curve(*circle);
  auto spline = fit_spline(points, true, tolerance);
  if (!spline) return spline.failure();
  return Curve(*std::move(spline));
}

/// The points from one corner to the next, both included.
std::vector<Vec<2>> chain(const ContourSamples& samples, int corner, int next) {
  const int n = static_cast<int>(samples.points.size());
  std::vector<Vec<2>> points;
  for (int i = corner; i <= (next > corner ? next : next + n); ++i) points.push_back(samples.points[i % n]);
  return points;
}

/// Between neighbouring corners, given by ascending indices of samples. `is_closed`: also from the last to
/// the first.
Expected<std::vector<Curve>, NoFit> fit_between(const std::vector<int>& corners,
                                                const ContourSamples& samples, bool is_closed,
                                                double tolerance) {
  std::vector<Curve> curves;
  if (corners.empty()) {
    auto whole = fit_closed(samples.points, tolerance);
    if (!whole) return whole.failure();
    curves.push_back(*std::move(whole));
  }
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k + (is_closed ? 0 : 1) < n; ++k) {
    auto part = fit_open(chain(samples, corners[k], corners[(k + 1) % n]), tolerance);
    if (!part) return part.failure();
    curves.push_back(*std::move(part));
  }
  return curves;
}

/// The sharpest kink near a place that is not a corner yet; -1 if there is none.
int next_corner(const ContourSamples& samples, const std::vector<int>& corners, const Vec<2>& place,
                double distance) {
  int sharpest = -1;
  for (int i = 0; i < static_cast<int>(samples.points.size()); ++i) {
    if (samples.kinks[i] < least_corner_angle || std::ranges::binary_search(corners, i)) continue;
    if (wheelwright::distance(samples.points[i], place) > distance) continue;
    if (sharpest < 0 || samples.kinks[i] > samples.kinks[sharpest]) sharpest = i;
  }
  return sharpest;
}

/// Makes more kinks to corners until curves follow the samples between them.
Expected<std::vector<Curve>, NoFit> fit_between_kinks(std::vector<int> corners, const ContourSamples& samples,
                                                      bool is_closed, double tolerance) {
  constexpr double neighbourhood = 100;  // tolerances
  while (true) {
    auto curves = fit_between(corners, samples, is_closed, tolerance);
    if (curves) return curves;
    const int corner = next_corner(samples, corners, curves.failure().place, neighbourhood * tolerance);
    if (corner < 0) return curves.failure();
    corners.insert(std::ranges::upper_bound(corners, corner), corner);
  }
}

std::vector<int> sharp_corners(const ContourSamples& samples) {
  std::vector<int> corners;
  for (int i = 0; i < static_cast<int>(samples.points.size()); ++i)
    if (samples.kinks[i] > corner_angle) corners.push_back(i);
  return corners;
}

}  // namespace

Expected<std::vector<Curve>, NoFit> fit_loop(const ContourSamples& samples, double tolerance) {
  return fit_between_kinks(sharp_corners(samples), samples, true, share_of_fit * tolerance);
}

Expected<std::vector<Curve>, NoFit> fit_chain(const ContourSamples& samples, double tolerance) {
  std::vector<int> corners = sharp_corners(samples);
  corners.insert(corners.begin(), 0);
  corners.push_back(static_cast<int>(samples.points.size()) - 1);
  return fit_between_kinks(std::move(corners), samples, false, share_of_fit * tolerance);
}

}  // namespace wheelwright::cad
