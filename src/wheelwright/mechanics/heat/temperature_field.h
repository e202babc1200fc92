#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// A scalar field in the material of one sector that is the same in all sectors, by its values at the nodes;
/// 0 at nodes of no cell with material.
template <int dim>
struct TemperatureField {
  Lattice<dim> lattice;
  std::vector<double> values;

  /// At a point of the unit cell of the cell at this position.
  double at(const std::array<int, dim>& cell, const Vec<dim>& xi) const {
    const ShapeFunctions<dim> shape(lattice.degree(), xi);
    double sum = 0;
    for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
      sum += shape.value[a] * values[lattice.node_index(lattice.cell_node(cell, a))];
    return sum;
  }
};

}  // namespace wheelwright
