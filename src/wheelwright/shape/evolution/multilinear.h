#pragma once

#include <span>
#include <vector>

#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

// Multilinear elements between the nodes of the lattice, in polar coordinates with the metric of the ring (r
// dr d(azimuth) [dz]). Velocity and smoothing use them for both degrees of the level set.

/// Multilinear interpolation at a point: the surrounding nodes and their weights.
template <int dim>
struct NodeWeights {
  std::array<int, power(2, dim)> node;
  std::array<double, power(2, dim)> weight;
};

/// Interpolation weights at the point `xi` of the unit cell of `cell`.
template <int dim>
NodeWeights<dim> node_weights(const Lattice<dim>& lattice, int cell, const Vec<dim>& xi);

/// Value of a nodal field at that point.
template <int dim>
double interpolate(const NodeWeights<dim>& at, std::span<const double> field) {
  double value = 0;
  for (std::size_t a = 0; a < at.node.size(); ++a) value += at.weight[a] * field[at.node[a]];
  return value;
}

/// Integral of a nodal field over the boundary: the sum of weight * field over its samples.
template <int dim>
double boundary_integral(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary,
                         std::span<const double> field);

/// Load vector of the sampled values: for each node the sum of weight * value * (its test function) over the
/// samples.
template <int dim>
std::vector<double> boundary_load(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary);

/// Lower triangle of the matrix of mass * (u, v) + stiffness * (grad u, grad v) on one sector.
template <int dim>
std::vector<SparseSpd::Entry> multilinear_form(const Lattice<dim>& lattice, double mass, double stiffness);

/// The matrix with the rows and columns of fixed nodes replaced by those of the identity.
std::vector<SparseSpd::Entry> with_fixed_nodes(std::span<const SparseSpd::Entry> matrix,
                                               const std::vector<bool>& fixed);

/// Product of the symmetric matrix with this lower triangle and x.
std::vector<double> symmetric_product(std::span<const SparseSpd::Entry> lower_triangle,
                                      std::span<const double> x);

/// The same for each component of x.
template <int dim>
std::vector<Vec<dim>> symmetric_product(std::span<const SparseSpd::Entry> lower_triangle,
                                        std::span<const Vec<dim>> x);

}  // namespace wheelwright
