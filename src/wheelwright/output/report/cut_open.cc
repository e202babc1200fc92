#include "wheelwright/output/report/cut_open.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/surface/check_surface.h"

namespace wheelwright {
namespace {

/// Azimuth in the full ring, in columns from the first one.
double column_at(const PolarGrid<3>& grid, const Vec<3>& place) {
  const double columns = grid.columns() * grid.n_sectors;
  const double at = std::atan2(place[1], place[0]) / grid.column_angle();
  return at < 0 ? at + columns : at;
}

/// A side of a polygon in a half-plane through the axle: radius and height of its ends.
struct Side {
  Vec<2> from, to;

  double height_at(double radius) const {
    return std::lerp(from[1], to[1], (radius - from[0]) / (to[0] - from[0]));
  }
};

/// The polygons with these sides, whatever they surround, as trapezoids between the radii of their corners.
/// Calls visit(corner, corner, corner, corner) for each, counter-clockwise if radii are to the right and
/// heights up.
template <class Visit>
void for_each_trapezoid(std::vector<Side> sides, Visit visit) {
  std::vector<double> radii;
  for (Side& side : sides) {
    if (side.to[0] < side.from[0]) std::swap(side.from, side.to);
    radii.push_back(side.from[0]);
    radii.push_back(side.to[0]);
  }
  std::ranges::sort(radii);
  for (std::size_t k = 1; k < radii.size(); ++k) {
    const double low = radii[k - 1], high = radii[k], middle = 0.5 * (low + high);
    std::vector<const Side*> crossed;
    for (const Side& side : sides)
      if (side.from[0] < middle && middle < side.to[0]) crossed.push_back(&side);
    std::ranges::sort(crossed, {}, [&](const Side* side) { return side->height_at(middle); });
    for (std::size_t i = 1; i < crossed.size(); i += 2)
      visit(Vec<2>{low, crossed[i - 1]->height_at(low)}, Vec<2>{high, crossed[i - 1]->height_at(high)},
            Vec<2>{high, crossed[i]->height_at(high)}, Vec<2>{low, crossed[i]->height_at(low)});
  }
}

/// Adds the face with these sides at the beginning of a column, which looks towards larger azimuths or the
/// other way.
void add_face(const std::vector<Side>& sides, double azimuth, bool looks_ahead, CutSurface& cut) {
  for_each_trapezoid(sides, [&](auto... corners) {
    const int first = static_cast<int>(cut.face_points.size());
    for (const Vec<2>& corner : {corners...})
      cut.face_points.push_back(cartesian<3>({corner[0], azimuth, corner[1]}));
    // Counter-clockwise as seen from smaller azimuths.
    for (std::array<int, 3> triangle :
         {std::array{first, first + 1, first + 2}, {first, first + 2, first + 3}}) {
      if (looks_ahead) std::swap(triangle[1], triangle[2]);
      cut.face_triangles.push_back(triangle);
    }
  });
}

}  // namespace

bool contains(const ColumnRange& columns, const PolarGrid<3>& grid, const Vec<3>& place) {
  const double at = column_at(grid, place);
  return at > columns.first && at < columns.last;
}

CutSurface cut_open(const SurfaceMesh& surface, const PolarGrid<3>& grid, const ColumnRange& removed) {
  CutSurface cut;
  std::set<std::pair<int, int>> open;  // sides of triangles without an opposite one
  for (const auto& triangle : surface.triangles) {
    const Vec<3> centre =
        (1.0 / 3) * (surface.points[triangle[0]] + surface.points[triangle[1]] + surface.points[triangle[2]]);
    if (contains(removed, grid, centre)) continue;
    cut.triangles.push_back(triangle);
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      if (open.erase({b, a}) == 0) open.insert({a, b});
    }
  }
  std::array<std::vector<Side>, 2> sides;
  const auto in_section = [](const Vec<3>& x) { return Vec<2>{std::hypot(x[0], x[1]), x[2]}; };
  for (const auto& [a, b] : open) {
    const Vec<3>&from = surface.points[a], &to = surface.points[b];
    const double at = column_at(grid, 0.5 * (from + to));
    sides[std::abs(at - removed.first) < std::abs(at - removed.last) ? 0 : 1].push_back(
        {in_section(from), in_section(to)});
  }
  add_face(sides[0], removed.first * grid.column_angle(), true, cut);
  add_face(sides[1], removed.last * grid.column_angle(), false, cut);
  return cut;
}

std::vector<double> section_areas(const SurfaceMesh& surface, const PolarGrid<3>& grid) {
  constexpr double on_section = 1e-6;  // columns
  const int columns = grid.ring_columns();
  std::vector<double> areas(columns, 0.0);
  for (const auto& triangle : surface.triangles) {
    const std::array<Vec<3>, 3> p{surface.points[triangle[0]], surface.points[triangle[1]],
                                  surface.points[triangle[2]]};
    const int column = static_cast<int>(column_at(grid, (1.0 / 3) * (p[0] + p[1] + p[2]))) % columns;
    for (int k = 0; k < 3; ++k) {
      const Vec<3>&a = p[k], &b = p[(k + 1) % 3];
      const double ahead = std::remainder(column_at(grid, 0.5 * (a + b)) - column, columns);
      if (std::abs(ahead) > on_section) continue;
      areas[column] += 0.5 * (std::hypot(a[0], a[1]) + std::hypot(b[0], b[1])) * (b[2] - a[2]);
    }
  }
  for (double& area : areas) area = std::abs(area);
  return areas;
}

bool has_closed_cavities(const SurfaceMesh& surface) {
  const auto report = check_surface(surface.points, surface.triangles);
  return report && report->cavities > 0;
}

}  // namespace wheelwright
