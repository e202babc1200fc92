#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/base/periodic.h"
#include "wheelwright/shape/geometry/lagrange.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Nodal values on the full ring, for output: values[component + components * (node + n_nodes * sector)] with
/// `node` and `n_nodes` those of the lattice of one sector. Vectors are Cartesian, in the body frame. NaN
/// where a node carries no material.
struct RingField {
  int components;
  std::vector<double> values;

  /// Of a field that jumps between layers of materials: `values` are those in the cells of the rows that are
  /// not odd, which belong to every other layer, and these are those in the odd ones. Both are empty if the
  /// field is continuous.
  std::vector<bool> is_odd_row = {};
  std::vector<double> odd_values = {};

  /// The values in the cells of a row.
  const std::vector<double>& in_row(int row) const {
    return is_odd_row.empty() || !is_odd_row[row] ? values : odd_values;
  }
};

/// A scalar of the components of a field at a point.
using PointScalar = std::function<double(std::span<const double>)>;

struct NamedScalar {
  std::string name;
  std::string unit;
  PointScalar of;
};

/// A field as it is shown to the user.
struct NamedField {
  std::string name;  ///< e.g. "displacement"
  std::string unit;  ///< e.g. "m"
  RingField field;
  /// The scalar that is shown, of the components at a point; absent: the components themselves.
  PointScalar scalar = {};
  std::vector<NamedScalar> beside = {};  ///< additional scalars in files
};

/// The index of a node of the full ring: its azimuthal position counts from azimuth 0 around the ring.
template <int dim>
std::size_t ring_node(const Lattice<dim>& lattice, std::array<int, dim> position) {
  const int per_sector = lattice.nodes()[1];
  const int azimuthal = wrap(position[1], per_sector * lattice.grid().n_sectors);
  position[1] = azimuthal % per_sector;
  return lattice.node_index(position) +
         static_cast<std::size_t>(lattice.n_nodes()) * (azimuthal / per_sector);
}

/// The start of the consecutive nodes of an azimuth.
template <int dim>
std::size_t ring_line(const Lattice<dim>& lattice, int azimuthal) {
  return ring_node<dim>(lattice, {0, azimuthal});
}

/// The mirror image of a continuous field in the middle plane of sector 0, which takes load position i of n
/// to position n - i: a sector further than the image in the plane of azimuth 0. A field with as many
/// components as the space has dimensions is one of vectors, any other one of scalars.
template <int dim>
RingField mirror_image(const Lattice<dim>& lattice, const RingField& field) {
  RingField image = field;
  const int per_sector = lattice.nodes()[1];
  const double angle = lattice.grid().sector_angle(), cosine = std::cos(angle), sine = std::sin(angle);
  for (int line = 0; line < per_sector * lattice.grid().n_sectors; ++line) {
    const double* from = &field.values[field.components * ring_line(lattice, line)];
    double* to = &image.values[field.components * ring_line(lattice, per_sector - line)];
    std::copy_n(from, field.components * lattice.nodes_per_line(), to);
    if (field.components != dim) continue;
    for (int node = 0; node < lattice.nodes_per_line(); ++node, from += dim, to += dim) {
      to[0] = cosine * from[0] + sine * from[1];
      to[1] = sine * from[0] - cosine * from[1];
    }
  }
  return image;
}

/// The nodes of a cell of the full ring, in local order.
template <int dim>
using RingCellNodes = std::array<std::size_t, ShapeFunctions<dim>::max_nodes>;

/// cell[1] counts columns around the ring.
template <int dim>
RingCellNodes<dim> ring_cell_nodes(const Lattice<dim>& lattice, const std::array<int, dim>& cell) {
  std::array<std::size_t, 3> lines;  // the first nodes of the cell's azimuths
  for (int k = 0; k <= lattice.degree(); ++k) lines[k] = ring_line(lattice, lattice.degree() * cell[1] + k);
  RingCellNodes<dim> nodes{};
  for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a) {
    const auto position = lattice.cell_node(cell, a);
    nodes[a] = lines[position[1] - lattice.degree() * cell[1]] + lattice.index_on_line(position);
  }
  return nodes;
}

/// One component of the field at a point of a cell with these nodes; `shape`: values of the shape functions
/// there, one per node. The cell's row matters only to fields that jump.
inline double interpolate(const RingField& field, std::span<const std::size_t> nodes,
                          std::span<const double> shape, int component, int row = 0) {
  const std::vector<double>& values = field.in_row(row);
  double value = 0;
  for (std::size_t a = 0; a < shape.size(); ++a)
    value += shape[a] * values[component + field.components * nodes[a]];
  return value;
}

/// All components there.
template <std::size_t n_components>
std::array<double, n_components> interpolate(const RingField& field, std::span<const std::size_t> nodes,
                                             std::span<const double> shape, int row = 0) {
  const std::vector<double>& of_nodes = field.in_row(row);
  std::array<double, n_components> values{};
  for (std::size_t a = 0; a < shape.size(); ++a) {
    const double* at_node = &of_nodes[n_components * nodes[a]];
    for (std::size_t c = 0; c < n_components; ++c) values[c] += shape[a] * at_node[c];
  }
  return values;
}

}  // namespace wheelwright
