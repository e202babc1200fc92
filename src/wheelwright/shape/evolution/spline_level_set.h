#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

// Quadratic level sets that move are tensor-product cubic B-splines over the polar grid, with knots at the
// vertices of the cells: they are smooth, and their edges bend over about a cell. The coefficients are the
// design variables. Otherwise the nodes between the vertices are independent variables, and edges grow teeth
// smaller than a cell, which the discrete energy rewards and the true one does not. Level sets of degree 1
// have vertices only: both functions return them as they are.

/// The coefficients of the spline that has the values of psi at the vertices. At its ends along the radius
/// (and the width) it is linear. The nodes between the vertices have values for transport(), by cubic
/// interpolation; spline_level_set() ignores them.
template <int dim>
LevelSet<dim> spline_coefficients(const LevelSet<dim>& psi);

/// The spline with these coefficients, at all nodes. Monotone: larger coefficients give a spline that is
/// nowhere smaller.
template <int dim>
LevelSet<dim> spline_level_set(const LevelSet<dim>& coefficients);

/// The weights of the coefficients around a cell along one axis in the value at xi in [0, 1]: those of the
/// vertices cell - 1, cell, cell + 1 and cell + 2 of `n_vertices`, zero for vertices that do not exist. For
/// degree 1 the weights of the vertices' values.
std::array<double, 4> spline_weights(int degree, int cell, double xi, int n_vertices, bool is_periodic);

/// Weights of the same coefficients for the derivatives of order 0 to 3 in xi of the spline itself, which a
/// level set of degree 2 interpolates at the nodes.
std::array<std::array<double, 4>, 4> spline_derivative_weights(int cell, double xi, int n_vertices,
                                                               bool is_periodic);

/// The dependence on one of the coefficients: its node, and the derivative.
struct Dependence {
  int node;
  double weight;
};

/// Adds the dependence of the level set at a point of the unit cell on its coefficients, times a factor.
template <int dim>
void add_dependences(const Lattice<dim>& lattice, const std::array<int, dim>& cell, const Vec<dim>& xi,
                     double factor, std::vector<Dependence>& to);

}  // namespace wheelwright
