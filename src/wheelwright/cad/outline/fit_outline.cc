#include "wheelwright/cad/outline/fit_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/fit_loop.h"
#include "wheelwright/shape/geometry/representative_contours.h"
#include "wheelwright/shape/geometry/zero_contour.h"

namespace wheelwright::cad {
namespace {

OutlineFault described(const NoFit& fault, double tolerance) {
  return {fmt::format("no curve follows the contour within {:.3g} mm at {}; the deviation is {:.3g} mm",
                      tolerance * 1e3, place_of(fault.place), fault.deviation * 1e3)};
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
    auto curves = fit_loop(sample_closed(contour->points, zero, sample_distance * tolerance), tolerance);
    if (!curves) return described(curves.failure(), tolerance);
    const Loop loop{signed_area(*contour) > 0 ? LoopKind::island : LoopKind::hole, *std::move(curves)};
    const int n_images = is_about_axle ? 1 : grid.n_sectors;
    for (int sector = 0; sector < n_images; ++sector)
      outline.loops.push_back(rotated_loop(loop, sector * grid.sector_angle()));
  }
  return outline;
}

}  // namespace wheelwright::cad
