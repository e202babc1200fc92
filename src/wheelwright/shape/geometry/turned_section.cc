#include "wheelwright/shape/geometry/turned_section.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "wheelwright/shape/geometry/marching_squares.h"

namespace wheelwright {
namespace {

double smallest_cell(const PolarGrid<3>& grid) {
  double smallest = grid.axial_size();
  for (const EqualRows& rows : grid.all_equal_rows()) smallest = std::min(smallest, rows.height());
  return smallest;
}

/// A polynomial on one cell by its nodal values in the part from `begin` to `end` of the cell's height.
std::vector<double> in_part(const std::vector<double>& nodal, int degree, double begin, double end) {
  std::vector<double> result;
  for (std::size_t a = 0; a < nodal.size(); ++a) {
    const auto p = local_node_position<2>(degree, static_cast<int>(a));
    const ShapeFunctions<2> shape(degree, {std::lerp(begin, end, static_cast<double>(p[0]) / degree),
                                           static_cast<double>(p[1]) / degree});
    double value = 0;
    for (std::size_t b = 0; b < nodal.size(); ++b) value += shape.value[b] * nodal[b];
    result.push_back(value);
  }
  return result;
}

/// An edge of the boundary of the material, with the material on its left.
struct Edge {
  SquareVertex start, end;
  SectionSide side;
};

/// The side on which an edge of a polygon of the material lies; nothing if it lies within the material.
std::optional<SectionSide> side_of(const SquareVertex& a, const SquareVertex& b,
                                   const SquareSamples& samples) {
  const int rows = samples.rows(), columns = samples.columns();
  if (a.has_row(0) && b.has_row(0)) return SectionSide::rim;
  if (a.has_row(rows) && b.has_row(rows)) return SectionSide::tread;
  if (a.has_column(0) && b.has_column(0)) return SectionSide::first_face;
  if (a.has_column(columns) && b.has_column(columns)) return SectionSide::last_face;
  if (a.site != SquareSite::sample && b.site != SquareSite::sample) return SectionSide::free;
  return {};
}

/// Radius and axial position are a left-handed pair of axes in a picture of the section: the edges of the
/// polygons are reversed.
std::vector<Edge> boundary_edges(const SquareSamples& samples) {
  std::vector<Edge> edges;
  for (int j = 0; j < samples.columns(); ++j)
    for (int i = 0; i < samples.rows(); ++i)
      for (const SquarePolygon& polygon : samples.square_polygons(i, j))
        for (std::size_t k = 0; k < polygon.size(); ++k) {
          const SquareVertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
          if (const auto side = side_of(a, b, samples)) edges.push_back({b, a, *side});
        }
  return edges;
}

/// Leaves out the points in the middle of a side and begins with that of a side, if there is one.
SectionContour without_middles(const std::vector<SectionContour::Corner>& corners) {
  SectionContour contour;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const SectionSide before = corners[(i + corners.size() - 1) % corners.size()].side,
                      after = corners[i].side;
    if (after != SectionSide::free && after == before) continue;
    if (after != SectionSide::free && begin == 0) begin = contour.corners.size();
    contour.corners.push_back(corners[i]);
  }
  std::rotate(contour.corners.begin(), contour.corners.begin() + begin, contour.corners.end());
  return contour;
}

}  // namespace

TurnedSection::TurnedSection(const LevelSet<3>& psi)
    : ZeroSet(psi.lattice.grid().outer_radius, smallest_cell(psi.lattice.grid())),
      width_(psi.lattice.grid().width),
      cell_(psi.lattice.grid().axial_size()),
      columns_(psi.lattice.grid().cells[2]),
      degree_(psi.lattice.degree()) {
  const PolarGrid<3>& grid = psi.lattice.grid();
  for (int line = 0; line <= grid.cells[0]; ++line) radii_.push_back(grid.radius(line));
  radii_.back() = grid.outer_radius;
  for (int column = 0; column < columns_; ++column)
    for (int row = 0; row < grid.cells[0]; ++row) {
      std::vector<double>& values = nodal_.emplace_back();
      for (int a = 0; a < nodes_per_cell<2>(degree_); ++a) {
        const auto p = local_node_position<2>(degree_, a);
        values.push_back(
            psi.values[psi.lattice.node_index({degree_ * row + p[0], 0, degree_ * column + p[1]})]);
      }
    }
}

TurnedSection TurnedSection::between(double inner, double outer) const {
  const double slack = 1e-9 * outer_radius();  // thinner parts of rows belong to the next one
  const int rows = cells()[0];
  int first = 0, last = rows - 1;
  while (first < last && radii_[first + 1] < inner + slack) ++first;
  while (last > first && radii_[last] > outer - slack) --last;
  TurnedSection part = *this;
  part.radii_.assign(radii_.begin() + first, radii_.begin() + last + 2);
  part.radii_.front() = inner;
  part.radii_.back() = outer;
  part.nodal_.clear();
  for (int column = 0; column < columns_; ++column)
    for (int row = first; row <= last; ++row) {
      const double height = radii_[row + 1] - radii_[row];
      part.nodal_.push_back(in_part(nodal_[column * rows + row], degree_,
                                    (part.radii_[row - first] - radii_[row]) / height,
                                    (part.radii_[row - first + 1] - radii_[row]) / height));
    }
  return part;
}

Vec<2> TurnedSection::point(const Vec<2>& place) const {
  const int row = std::clamp(static_cast<int>(std::floor(place[0])), 0, cells()[0] - 1);
  return {std::lerp(0, width_, place[1] / columns_), std::lerp(radii_[row], radii_[row + 1], place[0] - row)};
}

ZeroSet::Value TurnedSection::at(const Vec<2>& point) const {
  const int rows = cells()[0];
  const int row =
      static_cast<int>(std::upper_bound(radii_.begin() + 1, radii_.end() - 1, point[1]) - radii_.begin() - 1);
  const int column = std::clamp(static_cast<int>(std::floor(point[0] / cell_)), 0, columns_ - 1);
  const double height = radii_[row + 1] - radii_[row];
  const ShapeFunctions<2> shape(degree_, {(point[1] - radii_[row]) / height, point[0] / cell_ - column});
  const auto& nodal = nodal_[column * rows + row];
  Value result{};
  for (std::size_t a = 0; a < nodal.size(); ++a) {
    result.psi += nodal[a] * shape.value[a];
    result.gradient += nodal[a] * Vec<2>{shape.gradient[a][1] / cell_, shape.gradient[a][0] / height};
  }
  return result;
}

std::vector<SectionContour> material_contours(const TurnedSection& section, int subdivisions) {
  const SquareSamples samples(section.cells(), section.degree(), section.nodal(), subdivisions);
  const std::vector<Edge> edges = boundary_edges(samples);
  const auto number = [&](const SquareVertex& v) {
    return 3 * (v.j * (samples.rows() + 1) + v.i) + static_cast<int>(v.site);
  };
  std::unordered_map<int, int> from;  // the edge that begins at a vertex
  for (int k = 0; k < std::ssize(edges); ++k) from[number(edges[k].start)] = k;
  std::vector<SectionContour> contours;
  std::vector<bool> used(edges.size(), false);
  for (int first = 0; first < std::ssize(edges); ++first) {
    if (used[first]) continue;
    std::vector<SectionContour::Corner> corners;
    for (int k = first; !used[k]; k = from.at(number(edges[k].end))) {
      used[k] = true;
      corners.push_back({section.point((1.0 / subdivisions) * edges[k].start.position()), edges[k].side});
    }
    contours.push_back(without_middles(corners));
  }
  return contours;
}

}  // namespace wheelwright
