#include "wheelwright/run/commands/shape_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

/// A hole of this form in every sector of a ring of material.
Composition in_all_sectors(const std::vector<DrawnOutline>& outlines, int n_sectors) {
  Figure figure{Fill::hole, {}};
  for (int sector = 0; sector < n_sectors; ++sector) {
    const Affine turn = Affine::rotation(2 * std::numbers::pi * sector / n_sectors);
    for (const DrawnOutline& outline : outlines) figure.outlines.push_back(outline.mapped(turn));
  }
  return Composition({figure});
}

/// The counter-clockwise winding number of a closed polyline about a point.
int turns_round(std::span<const Point> corners, const Point& x) {
  int turns = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a[1] <= x[1]) == (b[1] <= x[1])) continue;
    const double side = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
    if (b[1] > a[1] && side > 0) ++turns;
    if (b[1] < a[1] && side < 0) --turns;
  }
  return turns;
}

}  // namespace

template <int dim>
LevelSet<dim> with_stroke(const LevelSet<dim>& psi, const Stroke& stroke) {
  const auto drawn =
      make_level_set(psi.lattice, in_all_sectors(stroke.figure.outlines, psi.lattice.grid().n_sectors));
  LevelSet<dim> result = psi;
  for (std::size_t k = 0; k < result.values.size(); ++k) {
    const double inside = drawn.values[k] + stroke.growth;
    result.values[k] = stroke.figure.fill == Fill::hole ? std::max(result.values[k], inside)
                                                        : std::min(result.values[k], -inside);
  }
  return result;
}

std::vector<Point> hole_contour(const LevelSet<2>& psi, const Point& point) {
  const auto contours = material_contours(psi, contour_subdivisions(psi.lattice.degree()));
  for (const Contour& contour : contours) {
    if (contour.kind != ContourKind::free || signed_area(contour) >= 0) continue;
    std::vector<Point> corners(contour.points.begin(), contour.points.end());
    if (turns_round(corners, point) == 0 || turns_round(corners, Point{}) != 0) continue;
    // An island of material in the hole is not part of it.
    const bool is_on_island = std::ranges::any_of(contours, [&](const Contour& other) {
      return other.kind == ContourKind::free && signed_area(other) > 0 &&
             signed_area(other) < -signed_area(contour) &&
             turns_round(std::vector<Point>(other.points.begin(), other.points.end()), point) != 0;
    });
    if (!is_on_island) return corners;
  }
  return {};
}

Point centroid(std::span<const Point> corners) {
  double area = 0;
  Point moment{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const double twice = a[0] * b[1] - a[1] * b[0];
    area += twice / 2;
    for (int d = 0; d < 2; ++d) moment[d] += twice * (a[d] + b[d]) / 6;
  }
  return {moment[0] / area, moment[1] / area};
}

template decltype(with_stroke<2>) with_stroke<2>;
template decltype(with_stroke<3>) with_stroke<3>;

}  // namespace wheelwright
