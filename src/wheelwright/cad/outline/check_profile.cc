#include "wheelwright/cad/outline/check_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/cad/outline/outline_checks.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright::cad {
namespace {

/// Whether a curve is a line on a side of the section.
bool is_on_side(const Curve& curve, const TurnedSection& section) {
  const auto* line = std::get_if<Line>(&curve);
  if (!line) return false;
  const auto both = [&](int axis, double value) {
    return line->start[axis] == value && line->end[axis] == value;
  };
  return both(0, 0) || both(0, section.width()) || both(1, section.inner_radius()) ||
         both(1, section.outer_radius());
}

/// The deviation of the points of the contours from the edges. Points on the edges are so near to each other
/// that the nearest one is hardly farther than the edge, also where another edge is as near.
Deviation of_contours(const TurnedSection& section, const std::vector<std::vector<Vec<2>>>& polygons,
                      double tolerance) {
  const double step = std::max(0.5 * tolerance, 1e-5 * section.outer_radius());
  std::vector<Vec<2>> points;
  for (const SectionContour& contour : material_contours(section, contour_subdivisions(section.degree())))
    for (const auto& corner : contour.corners) points.push_back(corner.point);
  return deviation_of(points, polygons, step);
}

/// Volume of the body {psi < 0} [m^3] by contours with short chords.
double volume_of(const TurnedSection& section) {
  constexpr int squares_per_cell = 64;
  Outline polygons;
  for (const SectionContour& contour : material_contours(section, squares_per_cell)) {
    Loop& loop = polygons.loops.emplace_back(Loop{LoopKind::hole, {}});
    const std::size_t n = contour.corners.size();
    for (std::size_t i = 0; i < n; ++i)
      loop.curves.emplace_back(Line{contour.corners[i].point, contour.corners[(i + 1) % n].point});
  }
  return volume_of_revolution(polygons);
}

double checked_volume_error(const Outline& profile, const TurnedSection& section, Faults& faults) {
  constexpr double largest = 1e-4;
  const double error = volume_of_revolution(profile) / volume_of(section) - 1;
  if (!(std::abs(error) <= largest))
    faults.push_back(
        {fmt::format("the volume of the material differs by {:.3g} % from that of the level set; decrease "
                     "--tolerance",
                     100 * error)});
  return error;
}

}  // namespace

Expected<ProfileReport, std::vector<OutlineFault>> check_profile(const Outline& profile,
                                                                 const TurnedSection& section,
                                                                 double tolerance) {
  constexpr double share_of_chords = 0.05, share_of_ends = 1e-9;
  std::vector<std::vector<Vec<2>>> polygons;
  for (const Loop& loop : profile.loops) polygons.push_back(flattened(loop, share_of_chords * tolerance));
  Faults faults;
  check_closed(profile, share_of_ends * section.outer_radius(), place_in_section, faults);
  check_crossings(polygons, place_in_section, faults);
  Deviation deviation = of_contours(section, polygons, tolerance);
  for (const Loop& loop : profile.loops)
    for (const Curve& curve : loop.curves) {
      if (is_on_side(curve, section)) continue;
      check_side(loop.kind, curve, section, tolerance, place_in_section, faults);
      deviation.include(deviation_of(curve, section));
    }
  check_deviation(deviation, tolerance, place_in_section, faults);
  const double volume_error = checked_volume_error(profile, section, faults);
  if (!faults.empty()) return faults;
  const auto cavities = std::ranges::count(profile.loops, LoopKind::hole, &Loop::kind);
  return ProfileReport{
      .curves = count(profile),
      .bodies = static_cast<int>(profile.loops.size() - cavities),
      .cavities = static_cast<int>(cavities),
      .volume = volume_of_revolution(profile),
      .volume_error = volume_error,
      .deviation = deviation.distance,
      .deviation_place = deviation.place,
      .wall = clearances(profile, 1, clearance_step * section.outer_radius()).wall,
  };
}

std::string text(const ProfileReport& report) {
  constexpr double mm = 1e3;
  const auto line = [](const char* what, const std::string& value) {
    return fmt::format("{:<16} {}\n", what, value);
  };
  return line("profile", text(report.curves)) +
         line("bodies", fmt::format("{}, with {} closed cavities", report.bodies, report.cavities)) +
         line("volume", fmt::format("{:.0f} mm^3, {:+.1e} of the level set's", report.volume * mm * mm * mm,
                                    report.volume_error)) +
         line("deviation", fmt::format("{:.4f} mm at {}", report.deviation * mm,
                                       place_in_section(report.deviation_place))) +
         line("smallest wall", report.wall
                                   ? fmt::format("{:.2f} mm at {}", report.wall->width * mm,
                                                 place_in_section((report.wall->from + report.wall->to) / 2))
                                   : "none");
}

}  // namespace wheelwright::cad
