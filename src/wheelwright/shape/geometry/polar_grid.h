#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "wheelwright/shape/geometry/lagrange.h"

namespace wheelwright {

/// A circle of a grid, between the rim and the tread, whose radius is given.
struct FixedLine {
  int line;       ///< counted from the rim
  double radius;  ///< [m]

  bool operator==(const FixedLine&) const = default;
};

/// Neighbouring rows of cells of equal height.
struct EqualRows {
  int first, end;  ///< rows, counted from the rim, from `first` to before `end`
  double inner_radius, outer_radius;

  int count() const { return end - first; }
  double height() const { return (outer_radius - inner_radius) / count(); }  ///< [m]
};

/// A structured grid of one sector of a ring: axis 0 is radial (inner to outer radius), axis 1 azimuthal (one
/// sector, periodic) and axis 2 axial (dim = 3). All cells have the same size along azimuth and axle; the
/// rows of cells have equal heights between two fixed lines, the rim or the tread. Lengths are in metres and
/// angles in radians; azimuth 0 is the first face of the sector.
template <int dim>
struct PolarGrid {
  double inner_radius;         ///< R_i, the rim
  double outer_radius;         ///< R_e, the tread
  double width;                ///< w_r, along the axle; the extent of axis 2 when dim = 3
  int n_sectors;               ///< N_s
  std::array<int, dim> cells;  ///< number of cells of one sector along each axis
  /// The lines at given radii, e.g. between materials, outwards. None: all rows have the same height.
  std::vector<FixedLine> fixed_lines;

  PolarGrid() = default;
  // GCC 12 does not take the initializer lists of an aggregate with a default for the last member.
  PolarGrid(double inner, double outer, double along_axle, int sectors, const std::array<int, dim>& of_cells,
            std::vector<FixedLine> lines = {})
      : inner_radius(inner),
        outer_radius(outer),
        width(along_axle),
        n_sectors(sectors),
        cells(of_cells),
        fixed_lines(std::move(lines)) {}

  bool operator==(const PolarGrid&) const = default;

  double sector_angle() const { return 2 * std::numbers::pi / n_sectors; }
  int columns() const { return cells[1]; }                   ///< number of angular cells of a sector
  int ring_columns() const { return cells[1] * n_sectors; }  ///< number of angular cells of the full ring

  double column_angle() const { return sector_angle() / cells[1]; }  ///< of an angular cell [rad]
  double axial_size() const                                          ///< of a cell along the axle [m]
      requires(dim == 3) {
    return width / cells[2];
  }

  /// The rows of equal height to which a row belongs.
  EqualRows equal_rows(int row) const {
    return equal_rows_until([&](const FixedLine& fixed) { return row < fixed.line; });
  }
  /// Those from the rim to the first fixed line, from there to the next, ..., to the tread.
  std::vector<EqualRows> all_equal_rows() const {
    std::vector<EqualRows> result{equal_rows(0)};
    while (result.back().end < cells[0]) result.push_back(equal_rows(result.back().end));
    return result;
  }

  double row_height(int row) const { return equal_rows(row).height(); }  ///< [m]

  /// The height of the rows from `first` to before `end` together [m].
  double height_of_rows(int first, int end) const {
    double sum = 0;
    for (const EqualRows& rows : all_equal_rows())
      sum += std::max(0, std::min(end, rows.end) - std::max(first, rows.first)) * rows.height();
    return sum;
  }

  /// The radius of a line of the grid, counted from the rim, or of a place between lines [m].
  double radius(double line) const {
    const EqualRows rows = equal_rows(static_cast<int>(std::floor(line)));
    return rows.inner_radius + (line - rows.first) * rows.height();
  }

  /// The line, or the place between lines, at a radius: the inverse of radius(). Rows continue beyond rim and
  /// tread.
  double line_at(double radius) const {
    const EqualRows rows = equal_rows_until([&](const FixedLine& fixed) { return radius < fixed.radius; });
    return rows.first + (radius - rows.inner_radius) / rows.height();
  }

  /// The row in which a circle lies; beyond rim and tread the nearest one.
  int row_at(double radius) const {
    return std::clamp(static_cast<int>(std::floor(line_at(radius))), 0, cells[0] - 1);
  }

  /// The radius in the middle of the cells of a row [m].
  double middle_of_row(int row) const { return radius(row + 0.5); }

  /// Extent of a cell of a row along each axis, in (m, rad, m).
  Vec<dim> cell_size(int row) const {
    Vec<dim> size;
    size[0] = row_height(row);
    size[1] = column_angle();
    if constexpr (dim == 3) size[2] = axial_size();
    return size;
  }

  /// Coordinates (radius, azimuth[, axial]) of a point of the unit cell of the cell at this position.
  Vec<dim> polar_point(const std::array<int, dim>& cell, const Vec<dim>& xi) const {
    Vec<dim> x;
    x[0] = radius(cell[0] + xi[0]);
    x[1] = (cell[1] + xi[1]) * column_angle();
    if constexpr (dim == 3) x[2] = (cell[2] + xi[2]) * axial_size();
    return x;
  }

  /// The grid line, counted from the rim, that is nearest to a circle, and how far outside it the circle lies
  /// [m].
  struct LineAtRadius {
    int line;
    double distance;
  };
  LineAtRadius nearest_line(double at) const {
    const int line = static_cast<int>(std::lround(line_at(at)));
    return {line, at - radius(line)};
  }

  /// The length h [m] in which steps and bands are measured: the shortest edge of a cell, along the azimuth
  /// at the mean radius of the ring.
  double resolution() const {
    double h = column_angle() * 0.5 * (inner_radius + outer_radius);
    for (const EqualRows& rows : all_equal_rows()) h = std::min(h, rows.height());
    if constexpr (dim == 3) h = std::min(h, axial_size());
    return h;
  }

  int n_cells() const {
    int n = 1;
    for (int c : cells) n *= c;
    return n;
  }

  /// Index of the cell at a position. The radial position varies fastest and the azimuthal position slowest,
  /// so that the cells of one angular column are contiguous.
  int cell_index(const std::array<int, dim>& c) const {
    int index = c[1];
    if constexpr (dim == 3) index = index * cells[2] + c[2];
    return index * cells[0] + c[0];
  }

  /// Position of a cell along each axis.
  std::array<int, dim> cell_position(int index) const {
    std::array<int, dim> c;
    c[0] = index % cells[0];
    index /= cells[0];
    if constexpr (dim == 3) {
      c[2] = index % cells[2];
      index /= cells[2];
    }
    c[1] = index;
    return c;
  }

 private:
  /// The equal rows before the first fixed line that `is_beyond`.
  template <class Predicate>
  EqualRows equal_rows_until(Predicate is_beyond) const {
    EqualRows rows{0, cells[0], inner_radius, outer_radius};
    for (const auto& [line, radius] : fixed_lines) {
      if (is_beyond({line, radius})) {
        rows.end = line;
        rows.outer_radius = radius;
        break;
      }
      rows.first = line;
      rows.inner_radius = radius;
    }
    return rows;
  }
};

/// Area [m^2] of the whole sector including the holes, or its volume [m^3] when dim = 3.
template <int dim>
double sector_measure(const PolarGrid<dim>& grid);

/// The grid of the first half of a wheel's width; the number of cells along the axle must be even.
inline PolarGrid<3> first_half(PolarGrid<3> grid) {
  grid.width /= 2;
  grid.cells[2] /= 2;
  return grid;
}

/// Cartesian position of a point given as (radius, azimuth[, axial]).
template <int dim>
Vec<dim> cartesian(const Vec<dim>& polar) {
  Vec<dim> x = polar;
  x[0] = polar[0] * std::cos(polar[1]);
  x[1] = polar[0] * std::sin(polar[1]);
  return x;
}

/// Radius, azimuth in (-pi, pi][, and axial position] of a point of the body frame.
template <int dim>
Vec<dim> polar(const Vec<dim>& x) {
  Vec<dim> result = x;
  result[0] = std::hypot(x[0], x[1]);
  result[1] = std::atan2(x[1], x[0]);
  return result;
}

/// The nodes of a sector's grid for elements of degree `degree`. The lattice is periodic in azimuth: the
/// nodes of the last face of a sector are those of the first face of the next sector. The radial position
/// varies fastest in the node index and the azimuthal position slowest.
template <int dim>
class Lattice {
 public:
  Lattice(const PolarGrid<dim>& grid, int degree) : grid_(grid), degree_(degree) {
    for (int d = 0; d < dim; ++d) nodes_[d] = degree * grid.cells[d] + (d == 1 ? 0 : 1);
  }

  const PolarGrid<dim>& grid() const { return grid_; }
  int degree() const { return degree_; }
  const std::array<int, dim>& nodes() const {
    return nodes_;
  }  ///< number of nodes of one sector along each axis

  int n_nodes() const {
    int n = 1;
    for (int k : nodes_) n *= k;
    return n;
  }
  /// Number of nodes at one azimuth.
  int nodes_per_line() const {
    if constexpr (dim == 3) return nodes_[0] * nodes_[2];
    return nodes_[0];
  }

  /// Index of a node among those at its azimuth.
  int index_on_line(const std::array<int, dim>& position) const {
    if constexpr (dim == 3) return position[2] * nodes_[0] + position[0];
    return position[0];
  }

  /// Index of the node at a position. position[1] is taken modulo nodes()[1].
  int node_index(const std::array<int, dim>& position) const {
    return (position[1] % nodes_[1] + nodes_[1]) % nodes_[1] * nodes_per_line() + index_on_line(position);
  }

  /// Position of a node along each axis.
  std::array<int, dim> node_position(int index) const {
    std::array<int, dim> p;
    p[0] = index % nodes_[0];
    index /= nodes_[0];
    if constexpr (dim == 3) {
      p[2] = index % nodes_[2];
      index /= nodes_[2];
    }
    p[1] = index;
    return p;
  }

  /// Position of a local node of the cell at position `cell`. On the last face of the sector its azimuthal
  /// position is nodes()[1].
  std::array<int, dim> cell_node(const std::array<int, dim>& cell, int local_node) const {
    auto position = local_node_position<dim>(degree_, local_node);
    for (int d = 0; d < dim; ++d) position[d] += degree_ * cell[d];
    return position;
  }

  /// Distance of neighbouring nodes in a row of cells along each axis, in (m, rad, m).
  Vec<dim> spacing(int row) const {
    Vec<dim> h = grid_.cell_size(row);
    for (double& x : h) x /= degree_;
    return h;
  }
  double node_angle() const { return grid_.column_angle() / degree_; }  ///< between neighbouring nodes [rad]

  // Radial places are also given in units of nodes: the node at the radial position p lies at p.

  /// The row of cells in which such a place lies; on a line the outer one.
  int row_of(double place) const {
    return std::clamp(static_cast<int>(std::floor(place / degree_)), 0, grid_.cells[0] - 1);
  }
  /// The radius of such a place [m].
  double radius(double place) const {
    const EqualRows rows = grid_.equal_rows(row_of(place));
    return rows.inner_radius + (place - degree_ * rows.first) * (rows.height() / degree_);
  }
  /// The place at a radius, the inverse of radius().
  double place_at(double radius) const {
    const EqualRows rows = grid_.equal_rows(grid_.row_at(radius));
    return degree_ * rows.first + (radius - rows.inner_radius) / (rows.height() / degree_);
  }
  /// How far the circle at place b lies outside that at place a [m].
  double radial_distance(double a, double b) const {
    const EqualRows rows = grid_.equal_rows(row_of(a));
    const bool are_together = grid_.fixed_lines.empty() || rows.first == grid_.equal_rows(row_of(b)).first;
    return are_together ? (b - a) * (rows.height() / degree_) : radius(b) - radius(a);
  }

  /// Coordinates (radius, azimuth[, axial]) of a place in units of nodes.
  Vec<dim> polar_of(const Vec<dim>& place) const {
    Vec<dim> x;
    x[0] = radius(place[0]);
    x[1] = place[1] * node_angle();
    if constexpr (dim == 3) x[2] = place[2] * (grid_.axial_size() / degree_);
    return x;
  }

  /// Coordinates (radius, azimuth[, axial]) of a node; position[1] may lie outside the sector.
  Vec<dim> polar_point(const std::array<int, dim>& position) const {
    Vec<dim> place;
    for (int d = 0; d < dim; ++d) place[d] = position[d];
    return polar_of(place);
  }
  Vec<dim> polar_point(int index) const { return polar_point(node_position(index)); }

 private:
  PolarGrid<dim> grid_;
  int degree_;
  std::array<int, dim> nodes_;
};

}  // namespace wheelwright
