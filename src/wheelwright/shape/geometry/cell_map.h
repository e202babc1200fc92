#pragma once

#include "wheelwright/shape/geometry/axle_rotation.h"
#include "wheelwright/shape/geometry/lagrange.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Isoparametric map of degree 1 or 2 from the unit cell to one grid cell, in the Cartesian frame of the
/// cell: its first axis is radial at the first azimuth of the cell. All cells of one radial (and axial) row
/// have the same map.
template <int dim>
class CellMap {
 public:
  CellMap(const PolarGrid<dim>& grid, int degree, std::array<int, dim> cell) : degree_(degree) {
    cell[1] = 0;
    const Lattice<dim> lattice(grid, degree);
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a)
      nodes_[a] = cartesian<dim>(lattice.polar_point(lattice.cell_node(cell, a)));
  }

  /// Position of the point where the shape functions have these values.
  Vec<dim> position(const ShapeFunctions<dim>& shape) const {
    Vec<dim> x{};
    for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a) x += shape.value[a] * nodes_[a];
    return x;
  }

  /// Jacobian dx_i / dxi_j.
  Mat<dim> jacobian(const ShapeFunctions<dim>& shape) const {
    Mat<dim> j{};
    for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a)
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) j[i][k] += nodes_[a][i] * shape.gradient[a][k];
    return j;
  }

  /// Second derivative d^2 x / dm^2 at xi for a direction m in the coordinates of the unit cell.
  Vec<dim> second_derivative(const Vec<dim>& xi, const Vec<dim>& m) const {
    Vec<dim> result{};
    for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a)
      result += shape_second_derivative<dim>(degree_, a, xi, m) * nodes_[a];
    return result;
  }

 private:
  int degree_;
  std::array<Vec<dim>, power(3, dim)> nodes_;
};

/// The physical surface element to which a reference surface element is mapped.
template <int dim>
struct SurfaceElement {
  Vec<dim> normal;  ///< unit normal
  double scale;     ///< dS / dS_ref
};

/// Maps a surface element with a unit reference normal by Nanson's formula: n dS = det(F) F^-T n_ref dS_ref,
/// where F is the Jacobian.
template <int dim>
SurfaceElement<dim> map_surface(const Mat<dim>& jacobian, const Vec<dim>& reference_normal) {
  const Vec<dim> n = transpose_times<dim>(inverse<dim>(jacobian), reference_normal);
  return {n / norm(n), norm(n) * determinant<dim>(jacobian)};
}

/// Returns v rotated by an angle [rad] about the axle.
template <int dim>
Vec<dim> rotated(const Vec<dim>& v, double angle) {
  return AxleRotation(angle).forward(v);
}

}  // namespace wheelwright
