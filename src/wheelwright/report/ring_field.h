#pragma once

#include <string>
#include <vector>

#include "wheelwright/geometry/lagrange.h"
#include "wheelwright/geometry/polar_grid.h"

namespace wheelwright {

/// Nodal values on the full ring, for output: values[component + components * (node + n_nodes * sector)] with
/// `node` and `n_nodes` those of the lattice of one sector. Vectors are Cartesian, in the body frame. NaN
/// where a node carries no material.
struct RingField {
  int components;
  std::vector<double> values;
};

/// A field as it is shown to the user.
struct NamedField {
  std::string name;  ///< e.g. "displacement"
  std::string unit;  ///< e.g. "m"
  RingField field;
};

/// One component of the field at a node of a sector's cell.
template <int dim>
double node_value(const Lattice<dim>& lattice, const RingField& field, int sector, int cell, int local_node,
                  int component) {
  const auto c = lattice.grid().cell_position(cell);
  auto p = local_node_position<dim>(lattice.degree(), local_node);
  for (int d = 0; d < dim; ++d) p[d] += lattice.degree() * c[d];
  const int node_sector = (sector + p[1] / lattice.nodes()[1]) % lattice.grid().n_sectors;
  const std::size_t node = lattice.node_index(p) + static_cast<std::size_t>(lattice.n_nodes()) * node_sector;
  return field.values[component + field.components * node];
}

/// One component of the field at a point of a sector's cell; `shape` is that point's, of the lattice's
/// degree.
template <int dim>
double interpolate(const Lattice<dim>& lattice, const RingField& field, int sector, int cell,
                   const ShapeFunctions<dim>& shape, int component) {
  double value = 0;
  for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
    value += shape.value[a] * node_value<dim>(lattice, field, sector, cell, a, component);
  return value;
}

}  // namespace wheelwright
