#pragma once

#include <span>
#include <vector>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/linalg/sparse_spd.h"

namespace wheelwright {

/// Multilinear elements on the lattice's own node grid, in polar coordinates with the metric of the ring
/// (r dr d(azimuth) [dz]). They carry the velocity and the smoothing whatever the degree of the level set.

/// A point's multilinear interpolation: the nodes around it and their weights.
template <int dim>
struct NodeWeights {
  std::array<int, power(2, dim)> node;
  std::array<double, power(2, dim)> weight;
};

/// Weights at the point `xi` of the unit cell of `cell`.
template <int dim>
NodeWeights<dim> node_weights(const Lattice<dim>& lattice, int cell, const Vec<dim>& xi);

/// The field at that point.
template <int dim>
double interpolate(const NodeWeights<dim>& at, std::span<const double> field) {
  double value = 0;
  for (std::size_t a = 0; a < at.node.size(); ++a) value += at.weight[a] * field[at.node[a]];
  return value;
}

/// Sum over the boundary of weight * field: the integral of a nodal field over the boundary.
template <int dim>
double boundary_integral(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary,
                         std::span<const double> field);

/// Sum over the boundary of weight * value * (test function of each node).
template <int dim>
std::vector<double> boundary_load(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary);

/// Lower triangle of mass * (u, v) + stiffness * (grad u, grad v) over one sector.
template <int dim>
std::vector<SparseSpd::Entry> multilinear_form(const Lattice<dim>& lattice, double mass, double stiffness);

/// The matrix with unit rows and columns in place of those of the fixed nodes.
std::vector<SparseSpd::Entry> with_fixed_nodes(std::span<const SparseSpd::Entry> matrix,
                                               const std::vector<bool>& fixed);

/// The symmetric matrix with this lower triangle times x.
std::vector<double> symmetric_product(std::span<const SparseSpd::Entry> lower_triangle,
                                      std::span<const double> x);

}  // namespace wheelwright
