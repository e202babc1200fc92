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
//
// Where rows of unequal height meet, the control points of the B-splines do not lie at the vertices but at
// the means of three of them (Greville). The coefficients remain values at the vertices: a control point has
// the value there of the straight line between two of them. So larger coefficients give a spline that is
// nowhere smaller, and a linear function of the radius has its own values as coefficients.

/// The coefficients of the spline that has the values of psi at the vertices. At its ends along the radius
/// (and the width) it is linear. The nodes between the vertices have values for transport(), by cubic
/// interpolation; spline_level_set() ignores them.
template <int dim>
LevelSet<dim> spline_coefficients(const LevelSet<dim>& psi);

/// The spline with these coefficients, at all nodes. Monotone: larger coefficients give a spline that is
/// nowhere smaller.
template <int dim>
LevelSet<dim> spline_level_set(const LevelSet<dim>& coefficients);

/// The vertices along an axis on whose coefficients the spline in a cell depends: the four nearest, or six
/// along the radius if rows have unequal heights. Some may not exist; their weights are zero.
struct SplineSupport {
  static constexpr int most = 6;
  int first, count;
};
template <int dim>
SplineSupport spline_support(const PolarGrid<dim>& grid, int axis, int cell);

/// The weights of these coefficients.
using SplineWeights = std::array<double, SplineSupport::most>;

/// In the value at xi in [0, 1]. For degree 1 the weights of the vertices' values.
template <int dim>
SplineWeights spline_weights(const PolarGrid<dim>& grid, int degree, int axis, int cell, double xi);

/// In the derivatives of order 0 to 3 in xi of the spline itself, which a level set of degree 2 interpolates
/// at the nodes.
template <int dim>
std::array<SplineWeights, 4> spline_derivative_weights(const PolarGrid<dim>& grid, int axis, int cell,
                                                       double xi);

/// The dependence on one of the coefficients: its node, and the derivative.
struct Dependence {
  int node;
  double weight;
};

/// Adds the dependence of the level set at a point of the unit cell on its coefficients, times a factor.
template <int dim>
void add_dependences(const Lattice<dim>& lattice, const std::array<int, dim>& cell, const Vec<dim>& xi,
                     double factor, std::vector<Dependence>& to);

/// The dependence of a control point (shape/geometry/control_points.h), at a node, of the level set on these
/// coefficients.
template <int dim>
std::vector<Dependence> control_point_dependence(const Lattice<dim>& lattice, int node);

}  // namespace wheelwright
