#include "wheelwright/shape/geometry/representative_contours.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// Disjoint contours differ in one of these.
struct Mark {
  Vec<2> centroid;
  double area;
};

Mark mark_of(const Contour& contour) {
  Vec<2> sum{};
  Vec<2> a = contour.points.back();
  for (const Vec<2>& b : contour.points) {
    sum += cross(a, b) * (a + b) / 6;
    a = b;
  }
  const double area = signed_area(contour);
  return {sum / area, area};
}

bool are_images(const Mark& mark, const Mark& other, const PolarGrid<2>& grid, double tolerance) {
  if (std::abs(mark.area - other.area) > tolerance * tolerance + 1e-6 * std::abs(mark.area)) return false;
  for (int sector = 1; sector < grid.n_sectors; ++sector)
    if (distance(rotated<2>(other.centroid, sector * grid.sector_angle()), mark.centroid) < tolerance)
      return true;
  return false;
}

}  // namespace

std::vector<RepresentativeContour> representatives(std::span<const Contour> contours,
                                                   const PolarGrid<2>& grid) {
  const double tolerance = 1e-7 * grid.outer_radius;
  std::vector<RepresentativeContour> chosen;
  std::vector<Mark> marks;
  for (const Contour& contour : contours) {
    if (contour.kind != ContourKind::free) continue;
    const Mark mark = mark_of(contour);
    if (std::ranges::any_of(marks,
                            [&](const Mark& other) { return are_images(mark, other, grid, tolerance); }))
      continue;
    chosen.push_back({&contour, norm(mark.centroid) < tolerance});
    marks.push_back(mark);
  }
  return chosen;
}

}  // namespace wheelwright
