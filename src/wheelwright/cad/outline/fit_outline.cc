#include "wheelwright/cad/outline/fit_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/circle_fit.h"
#include "wheelwright/cad/outline/contour_samples.h"
#include "wheelwright/cad/outline/spline_fit.h"
#include "wheelwright/shape/geometry/representative_contours.h"

namespace wheelwright::cad {
namespace {

/// Fraction of the tolerance for the fit at the samples; the rest is for the curve between them.
constexpr double share_of_fit = 0.8;
/// Distance of samples, in tolerances: a spline that rounds a kink of 20 degrees within the tolerance has
/// knots about 40 tolerances apart.
constexpr double sample_distance = 3;
/// A kink is a corner from this angle on [rad]. Polynomials of neighbouring cells meet at smaller angles
/// everywhere; the spline rounds them.
constexpr double corner_angle = 20 * std::numbers::pi / 180;
/// A kink of this angle also becomes a corner if no spline follows the contour otherwise [rad].
constexpr double least_corner_angle = std::numbers::pi / 180;

OutlineFault described(const NoFit& fault, double tolerance) {
  return {fmt::format("no curve follows the contour within {:.3g} mm at {}; the deviation is {:.3g} mm",
                      tolerance * 1e3, place_of(fault.place), fault.deviation * 1e3)};
}

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

/// `corners`: ascending indices of samples.
Expected<std::vector<Curve>, NoFit> fit_between(const std::vector<int>& corners,
                                                const ContourSamples& samples, double tolerance) {
  std::vector<Curve> curves;
  if (corners.empty()) {
    auto whole = fit_closed(samples.points, tolerance);
    if (!whole) return whole.failure();
    curves.push_back(*std::move(whole));
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    auto part = fit_open(chain(samples, corners[k], corners[(k + 1) % corners.size()]), tolerance);
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

Expected<std::vector<Curve>, NoFit> fit_loop(const ContourSamples& samples, double tolerance) {
  constexpr double neighbourhood = 100;  // tolerances
  std::vector<int> corners;
  for (int i = 0; i < static_cast<int>(samples.points.size()); ++i)
    if (samples.kinks[i] > corner_angle) corners.push_back(i);
  while (true) {
    auto curves = fit_between(corners, samples, tolerance);
    if (curves) return curves;
    const int corner = next_corner(samples, corners, curves.failure().place, neighbourhood * tolerance);
    if (corner < 0) return curves.failure();
    corners.insert(std::ranges::upper_bound(corners, corner), corner);
  }
}

Loop circle_about_axle(LoopKind kind, double radius) {
  const double sweep = kind == LoopKind::bore ? -2 * std::numbers::pi : 2 * std::numbers::pi;
  return {kind, {Arc{{0, 0}, radius, 0, sweep}}};
}

Loop rotated_loop(const Loop& loop, double angle) {
  Loop result{loop.kind, {}};
  for (const Curve& curve : loop.curves) result.curves.push_back(rotated(curve, angle));
  return result;
}

/// The place where a hole breaks through the edge of the ring, if any.
std::optional<OutlineFault> broken_edge(const std::vector<Contour>& contours, const PolarGrid<2>& grid) {
  const auto has = [&](ContourKind kind) {
    return std::ranges::any_of(contours, [&](const Contour& c) { return c.kind == kind; });
  };
  const bool tread = has(ContourKind::tread);
  if (tread && has(ContourKind::rim)) return {};
  const double edge = tread ? grid.inner_radius : grid.outer_radius;
  const auto miss = [edge](const Vec<2>& p) { return std::abs(norm(p) - edge); };
  Vec<2> nearest{edge, 0};
  double least = INFINITY;
  for (const Contour& contour : contours) {
    if (contour.kind != ContourKind::free) continue;
    for (const Vec<2>& p : contour.points)
      if (miss(p) < least) {
        least = miss(p);
        nearest = p;
      }
  }
  return OutlineFault{fmt::format("a hole breaks through the {} at {}; there the {} would be no circle",
                                  tread ? "bore" : "outer edge", place_of(nearest),
                                  tread ? "bore" : "outer edge")};
}

}  // namespace

Expected<Outline, OutlineFault> fit_outline(const LevelSet<2>& psi, double tolerance) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const auto contours = material_contours(psi, contour_subdivisions(psi.lattice.degree()));
  if (const auto fault = broken_edge(contours, grid)) return *fault;
  const ZeroContour zero(psi);
  Outline outline{{circle_about_axle(LoopKind::outer_edge, grid.outer_radius),
                   circle_about_axle(LoopKind::bore, grid.inner_radius)}};
  for (const auto& [contour, is_about_axle] : representatives(contours, grid)) {
    auto curves = fit_loop(sample(*contour, zero, sample_distance * tolerance), share_of_fit * tolerance);
    if (!curves) return described(curves.failure(), tolerance);
    const Loop loop{signed_area(*contour) > 0 ? LoopKind::island : LoopKind::hole, *std::move(curves)};
    const int n_images = is_about_axle ? 1 : grid.n_sectors;
    for (int sector = 0; sector < n_images; ++sector)
      outline.loops.push_back(rotated_loop(loop, sector * grid.sector_angle()));
  }
  return outline;
}

}  // namespace wheelwright::cad
