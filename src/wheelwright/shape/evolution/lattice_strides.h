#pragma once

#include <vector>

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

/// The first node of every line of nodes along an axis.
template <int dim>
std::vector<int> first_nodes(const Lattice<dim>& lattice, int axis) {
  std::vector<int> result;
  std::array<int, dim> end = lattice.nodes(), p{};
  end[axis] = 1;
  // In the order of the nodes: the azimuth varies slowest.
  for (p[1] = 0; p[1] < end[1]; ++p[1])
    for (int axial = 0; axial < (dim == 3 ? end[dim - 1] : 1); ++axial)
      for (p[0] = 0; p[0] < end[0]; ++p[0]) {
        if constexpr (dim == 3) p[2] = axial;
        result.push_back(lattice.node_index(p));
      }
  return result;
}

}  // namespace wheelwright
