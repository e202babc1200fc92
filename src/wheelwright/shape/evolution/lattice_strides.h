#pragma once

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Difference of the node indices of two neighbouring nodes along each axis, within one sector.
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
