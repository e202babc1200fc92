#include "wheelwright/cad/outline/check_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/triangulation.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/nearest_point.h"
#include "wheelwright/shape/geometry/zero_contour.h"

namespace wheelwright::cad {
namespace {

constexpr double largest_area_error = 1e-4;
/// Distance of points on edges, as a share of the outer radius.
constexpr double step_of_deviation = 1.5e-3;

using Faults = std::vector<OutlineFault>;

bool is_circle_about_axle(const Loop& loop) {
  return loop.kind == LoopKind::outer_edge || loop.kind == LoopKind::bore;
}

void check_closed(const Outline& outline, double slack, Faults& faults) {
  for (const Loop& loop : outline.loops) {
    const Curve* before = &loop.curves.back();
    for (const Curve& curve : loop.curves) {
      if (const double miss = distance(end_of(*before), start_of(curve)); !(miss <= slack))
        faults.push_back({fmt::format("the {} is open by {:.3g} mm at {}", name(loop.kind), miss * 1e3,
                                      place_of(start_of(curve)))});
      before = &curve;
    }
  }
}

/// The material must be on the left, at a distance that is larger than the tolerance.
void check_sides(const Outline& outline, const ZeroContour& zero, double tolerance, Faults& faults) {
  constexpr double parameter = 0.5, distance_in_tolerances = 3;
  for (const Loop& loop : outline.loops) {
    if (is_circle_about_axle(loop)) {
      if ((signed_area(loop) > 0) != (loop.kind == LoopKind::outer_edge))
        faults.push_back({fmt::format("the {} has the wrong orientation", name(loop.kind))});
      continue;
    }
    for (const Curve& curve : loop.curves) {
      const CurvePoint middle = at(curve, parameter);
      const double scale = distance_in_tolerances * tolerance / norm(middle.velocity);
      const Vec<2> left = scale * left_of(middle.velocity);
      const auto psi = [&](double side) { return zero.at(middle.position + side * left).psi; };
      if (!(psi(1) < psi(-1)))
        faults.push_back({fmt::format("the material is not on the left of the {} at {}", name(loop.kind),
                                      place_of(middle.position))});
    }
  }
}

void check_crossings(const std::vector<Polygon>& polygons, Faults& faults) {
  constexpr std::size_t max_shown = 10;
  const auto places = crossings(polygons);
  for (std::size_t i = 0; i < std::min(places.size(), max_shown); ++i)
    faults.push_back({"edges cross or touch at " + place_of(places[i])});
  if (places.size() > max_shown)
    faults.push_back({fmt::format("edges cross or touch at {} more places", places.size() - max_shown)});
}

/// Area of the whole wheel with circles for the outer and inner sides of the cells [m^2].
double area_of(const LevelSet<2>& psi) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const LevelSet<2> full{psi.lattice, std::vector<double>(psi.values.size(), -grid.outer_radius)};
  const double between_circles =
      std::numbers::pi * (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius);
  return between_circles - grid.n_sectors * (material_measure(full) - material_measure(psi));
}

double checked_area_error(const Outline& outline, const LevelSet<2>& psi, Faults& faults) {
  const double error = material_area(outline) / area_of(psi) - 1;
  if (!(std::abs(error) <= largest_area_error))
    faults.push_back({fmt::format("the area of the material differs by {:.3g} % from that of the level set",
                                  100 * error)});
  return error;
}

struct Deviation {
  double distance = 0;
  Vec<2> place{};
  void include(double d, const Vec<2>& p) {
    if (d <= distance) return;
    distance = d;
    place = p;
  }
};

/// The deviation of the edges of holes and islands from the zero contour; infinite for a point from which the
/// contour is not found.
Deviation of_curves(const Outline& outline, const ZeroContour& zero) {
  constexpr int points_per_cubic = 16;
  Deviation deviation;
  for (const Loop& loop : outline.loops) {
    if (is_circle_about_axle(loop)) continue;
    for (const Curve& curve : loop.curves) {
      const auto* spline = std::get_if<Spline>(&curve);
      const int n = points_per_cubic * (spline ? static_cast<int>(spline->points.size()) : 8);
      for (int i = 0; i <= n; ++i) {
        const Vec<2> p = at(curve, static_cast<double>(i) / n).position;
        const auto q = zero.projection(p);
        deviation.include(q ? distance(p, *q) : INFINITY, p);
      }
    }
  }
  return deviation;
}

/// Polygons with corners at most `step` apart, and the corners' neighbours.
struct DenseCorners {
  std::vector<Vec<2>> points;
  std::vector<int> before, after;

  DenseCorners(const std::vector<Polygon>& polygons, double step) {
    for (const Polygon& polygon : polygons) {
      const int first = static_cast<int>(points.size());
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const int parts = std::max(1, static_cast<int>(std::ceil(distance(a, b) / step)));
        for (int k = 0; k < parts; ++k) points.push_back(a + static_cast<double>(k) * (b - a) / parts);
      }
      const int end = static_cast<int>(points.size());
      for (int i = first; i < end; ++i) {
        before.push_back(i == first ? end - 1 : i - 1);
        after.push_back(i + 1 == end ? first : i + 1);
      }
    }
  }
};

/// The deviation of the points of the zero contour from the edges.
Deviation of_contour(const LevelSet<2>& psi, const std::vector<Polygon>& polygons) {
  const DenseCorners dense(polygons, step_of_deviation * psi.lattice.grid().outer_radius);
  const NearestPoint<2> nearest(dense.points);
  Deviation deviation;
  for (const Contour& contour : material_contours(psi, contour_subdivisions(psi.lattice.degree()))) {
    if (contour.kind != ContourKind::free) continue;
    for (const Vec<2>& p : contour.points) {
      const int corner = nearest.index_of_nearest(p);
      const Vec<2>& q = dense.points[corner];
      deviation.include(std::min(distance_to_segment(p, dense.points[dense.before[corner]], q),
                                 distance_to_segment(p, q, dense.points[dense.after[corner]])),
                        p);
    }
  }
  return deviation;
}

Deviation checked_deviation(const Outline& outline, const LevelSet<2>& psi, const ZeroContour& zero,
                            const std::vector<Polygon>& polygons, double tolerance, Faults& faults) {
  Deviation deviation = of_curves(outline, zero);
  const Deviation back = of_contour(psi, polygons);
  deviation.include(back.distance, back.place);
  if (!(deviation.distance <= tolerance))
    faults.push_back(
        {fmt::format("curve and contour are {:.4g} mm apart at {}, more than the tolerance of {:.4g} mm",
                     deviation.distance * 1e3, place_of(deviation.place), tolerance * 1e3)});
  return deviation;
}

std::string line(const char* what, const std::optional<Clearance>& clearance) {
  if (!clearance) return fmt::format("{:<16} none\n", what);
  return fmt::format("{:<16} {:.2f} mm at {}\n", what, clearance->width * 1e3,
                     place_of((clearance->from + clearance->to) / 2));
}

std::string line(const char* what, const std::optional<Bend>& bend) {
  if (!bend) return fmt::format("{:<16} none\n", what);
  return fmt::format("{:<16} radius {:.2f} mm at {}\n", what, bend->radius * 1e3, place_of(bend->place));
}

std::string text(const Roughness& roughness) {
  return fmt::format("{:<16} {:.2f} turns of an edge below {:.2f} mm, a cell, at {}\n", "roughness",
                     roughness.edge.turns, roughness.length * 1e3, place_of(roughness.edge.sharpest.place)) +
         line("internal corner", roughness.internal_corner) +
         line("external corner", roughness.external_corner);
}

}  // namespace

Expected<OutlineReport, std::vector<OutlineFault>> check_outline(const Outline& outline,
                                                                 const LevelSet<2>& psi, double tolerance) {
  constexpr double share_of_chords = 0.05, share_of_ends = 1e-9;
  const PolarGrid<2>& grid = psi.lattice.grid();
  const ZeroContour zero(psi);
  std::vector<Polygon> polygons;
  for (const Loop& loop : outline.loops) polygons.push_back(flattened(loop, share_of_chords * tolerance));
  Faults faults;
  check_closed(outline, share_of_ends * grid.outer_radius, faults);
  check_sides(outline, zero, tolerance, faults);
  check_crossings(polygons, faults);
  const double area_error = checked_area_error(outline, psi, faults);
  const Deviation deviation = checked_deviation(outline, psi, zero, polygons, tolerance, faults);
  if (!faults.empty()) return faults;
  return OutlineReport{.curves = count(outline),
                       .bodies = static_cast<int>(bodies(outline).size()),
                       .area = material_area(outline),
                       .area_error = area_error,
                       .deviation = deviation.distance,
                       .deviation_place = deviation.place,
                       .clearances = clearances(outline, grid.n_sectors, clearance_step * grid.outer_radius),
                       .roughness = roughness(outline, grid.n_sectors, grid.resolution())};
}

std::vector<OutlineFault> crossing_faults(const Outline& outline, double tolerance) {
  std::vector<Polygon> polygons;
  for (const Loop& loop : outline.loops) polygons.push_back(flattened(loop, tolerance));
  Faults faults;
  check_crossings(polygons, faults);
  return faults;
}

std::string text(const OutlineReport& report) {
  std::string result = fmt::format("{:<16} {}\n", "curves", text(report.curves));
  result += fmt::format("{:<16} {:.6g} mm^2, {:+.1e} of the level set's\n", "area", report.area * 1e6,
                        report.area_error);
  result += fmt::format("{:<16} {:.4f} mm at {}\n", "deviation", report.deviation * 1e3,
                        place_of(report.deviation_place));
  result += line("smallest wall", report.clearances.wall);
  result += line("smallest gap", report.clearances.gap);
  if (report.roughness) result += text(*report.roughness);
  return result;
}

}  // namespace wheelwright::cad
