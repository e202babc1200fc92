#include "wheelwright/cad/outline/check_outline.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "wheelwright/cad/outline/outline_checks.h"
#include "wheelwright/cad/outline/triangulation.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/zero_contour.h"

namespace wheelwright::cad {
namespace {

constexpr double largest_area_error = 1e-4;
/// Distance of points on edges, as a share of the outer radius.
constexpr double step_of_deviation = 1.5e-3;

bool is_circle_about_axle(const Loop& loop) {
  return loop.kind == LoopKind::outer_edge || loop.kind == LoopKind::bore;
}

void check_sides(const Outline& outline, const ZeroContour& zero, double tolerance, Faults& faults) {
  for (const Loop& loop : outline.loops) {
    if (is_circle_about_axle(loop)) {
      if ((signed_area(loop) > 0) != (loop.kind == LoopKind::outer_edge))
        faults.push_back({fmt::format("the {} has the wrong orientation", name(loop.kind))});
      continue;
    }
    for (const Curve& curve : loop.curves) check_side(loop.kind, curve, zero, tolerance, place_of, faults);
  }
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
    faults.push_back(
        {fmt::format("the area of the material differs by {:.3g} % from that of the level set; decrease "
                     "--tolerance",
                     100 * error)});
  return error;
}

/// The deviation of the edges of holes and islands from the zero contour.
Deviation of_curves(const Outline& outline, const ZeroContour& zero) {
  Deviation deviation;
  for (const Loop& loop : outline.loops)
    if (!is_circle_about_axle(loop))
      for (const Curve& curve : loop.curves) deviation.include(deviation_of(curve, zero));
  return deviation;
}

/// The deviation of the points of the zero contour from the edges.
Deviation of_contour(const LevelSet<2>& psi, const std::vector<Polygon>& polygons) {
  std::vector<Vec<2>> points;
  for (const Contour& contour : material_contours(psi, contour_subdivisions(psi.lattice.degree())))
    if (contour.kind == ContourKind::free)
      points.insert(points.end(), contour.points.begin(), contour.points.end());
  return deviation_of(points, polygons, step_of_deviation * psi.lattice.grid().outer_radius);
}

Deviation checked_deviation(const Outline& outline, const LevelSet<2>& psi, const ZeroContour& zero,
                            const std::vector<Polygon>& polygons, double tolerance, Faults& faults) {
  Deviation deviation = of_curves(outline, zero);
  deviation.include(of_contour(psi, polygons));
  check_deviation(deviation, tolerance, place_of, faults);
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
  check_closed(outline, share_of_ends * grid.outer_radius, place_of, faults);
  check_sides(outline, zero, tolerance, faults);
  check_crossings(polygons, place_of, faults);
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
  check_crossings(polygons, place_of, faults);
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
