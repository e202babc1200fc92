#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wheelwright/shape/geometry/lagrange.h"

namespace wheelwright {

/// A structured grid of one sector of a ring: axis 0 is radial (inner to outer radius), axis 1 azimuthal (one
/// sector, periodic) and axis 2 axial (dim = 3). All cells have the same size in (radius, azimuth, axial)
/// coordinates. Lengths are in metres and angles in radians; azimuth 0 is the first face of the sector.
template <int dim>
struct PolarGrid {
  double inner_radius;         ///< R_i, the rim
  double outer_radius;         ///< R_e, the tread
  double width;                ///< w_r, along the axle; the extent of axis 2 when dim = 3
  int n_sectors;               ///< N_s
  std::array<int, dim> cells;  ///< number of cells of one sector along each axis

  bool operator==(const PolarGrid&) const = default;

  double sector_angle() const { return 2 * std::numbers::pi / n_sectors; }
  int columns() const { return cells[1]; }                   ///< number of angular cells of a sector
  int ring_columns() const { return cells[1] * n_sectors; }  ///< number of angular cells of the full ring

  /// Extent of a cell along each axis, in (m, rad, m).
  Vec<dim> cell_size() const {
    Vec<dim> size;
    size[0] = (outer_radius - inner_radius) / cells[0];
    size[1] = sector_angle() / cells[1];
    if constexpr (dim == 3) size[2] = width / cells[2];
    return size;
  }

  /// The radius in the middle of the cells of a row [m].
  double middle_of_row(int row) const { return inner_radius + (row + 0.5) * cell_size()[0]; }

  /// The grid line, counted from the rim, that is nearest to a circle, and how far outside it the circle lies
  /// [m].
  struct LineAtRadius {
    int line;
    double distance;
  };
  LineAtRadius nearest_line(double radius) const {
    const double size = cell_size()[0];
    const int line = static_cast<int>(std::lround((radius - inner_radius) / size));
    return {line, radius - inner_radius - line * size};
  }

  /// The length h [m] in which steps and bands are measured: the shortest edge of a cell at the mean radius
  /// of the ring.
  double resolution() const {
    const Vec<dim> size = cell_size();
    double h = std::min(size[0], size[1] * 0.5 * (inner_radius + outer_radius));
    if constexpr (dim == 3) h = std::min(h, size[2]);
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

  /// Distance of neighbouring nodes along each axis, in (m, rad, m).
  Vec<dim> spacing() const {
    Vec<dim> h = grid_.cell_size();
    for (double& x : h) x /= degree_;
    return h;
  }

  /// Coordinates (radius, azimuth[, axial]) of a node; position[1] may lie outside the sector.
  Vec<dim> polar_point(const std::array<int, dim>& position) const {
    Vec<dim> x = componentwise_product(position, spacing());
    x[0] += grid_.inner_radius;
    return x;
  }
  Vec<dim> polar_point(int index) const { return polar_point(node_position(index)); }

 private:
  PolarGrid<dim> grid_;
  int degree_;
  std::array<int, dim> nodes_;
};

}  // namespace wheelwright
