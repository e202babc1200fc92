#pragma once

#include <algorithm>
#include <vector>

#include "wheelwright/shape/geometry/lagrange.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The level set psi (74) of one sector, negative in the material and positive in the holes: a piecewise
/// polynomial of the degree of the lattice (1 or 2), periodic in azimuth, given by its nodal values [m].
template <int dim>
struct LevelSet {
  Lattice<dim> lattice;
  std::vector<double> values;  ///< one value per lattice node

  /// Nodal values of one cell in the order of its local nodes.
  std::vector<double> cell_values(int cell) const {
    const auto position = lattice.grid().cell_position(cell);
    std::vector<double> result(nodes_per_cell<dim>(lattice.degree()));
    for (int a = 0; a < static_cast<int>(result.size()); ++a)
      result[a] = values[lattice.node_index(lattice.cell_node(position, a))];
    return result;
  }
};

/// Whether a node lies in a hole.
template <int dim>
bool has_holes(const LevelSet<dim>& psi) {
  return std::ranges::any_of(psi.values, [](double value) { return value > 0; });
}

/// A quadrature point of the moving boundary {psi = 0} of one sector.
template <int dim>
struct SurfacePoint {
  int cell;         ///< cell of the sector's grid
  Vec<dim> xi;      ///< position in the unit cell
  Vec<dim> normal;  ///< unit outward normal of the material, Cartesian, body frame
  double weight;    ///< boundary measure dS [m, or m^2 when dim = 3]
};

/// A value at a boundary point, e.g. the density G of the shape derivative (42).
template <int dim>
struct SurfaceSample : SurfacePoint<dim> {
  double value;
};

}  // namespace wheelwright
