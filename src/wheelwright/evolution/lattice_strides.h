#pragma once

#include "wheelwright/geometry/polar_grid.h"

namespace wheelwright {

/// By how much the node number grows from one node to the next along each axis, within one sector.
template <int dim>
std::array<int, dim> lattice_strides(const Lattice<dim>& lattice) {
  std::array<int, dim> strides;
  for (int axis = 0; axis < dim; ++axis) {
    std::array<int, dim> next{};
    next[axis] = 1;
    strides[axis] = lattice.node_index(next);
  }
  return strides;
}

}  // namespace wheelwright
