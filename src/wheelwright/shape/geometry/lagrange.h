#pragma once

#include <array>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Values, first and second derivatives at x of the Lagrange basis of degree 1 or 2 with equidistant nodes on
/// [0, 1].
struct Lagrange1D {
  std::array<double, 3> value{}, derivative{}, second{};

  Lagrange1D(int degree, double x) {
    if (degree == 1) {
      value = {1 - x, x, 0};
      derivative = {-1, 1, 0};
    } else {
      value = {(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)};
      derivative = {4 * x - 3, 4 - 8 * x, 4 * x - 1};
      second = {4, -8, 4};
    }
  }
};

/// Number of nodes of the tensor-product cell of this degree.
template <int dim>
constexpr int nodes_per_cell(int degree) {
  return power(degree + 1, dim);
}

/// Position of a local node of a cell along each axis, in 0..degree. Local nodes are numbered with axis 0
/// fastest.
template <int dim>
constexpr std::array<int, dim> local_node_position(int degree, int node) {
  std::array<int, dim> p{};
  for (int d = 0; d < dim; ++d) {
    p[d] = node % (degree + 1);
    node /= degree + 1;
  }
  return p;
}

/// Tensor-product Lagrange shape functions at one point of the unit cell, in the order of the local nodes.
template <int dim>
struct ShapeFunctions {
  static constexpr int max_nodes = power(3, dim);
  std::array<double, max_nodes> value;
  std::array<Vec<dim>, max_nodes> gradient;  ///< with respect to the coordinates of the unit cell

  ShapeFunctions(int degree, const Vec<dim>& xi) {
    const auto axes = evaluate_axes(degree, xi);
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
      const auto p = local_node_position<dim>(degree, a);
      value[a] = 1;
      for (int d = 0; d < dim; ++d) value[a] *= axes[d].value[p[d]];
      for (int g = 0; g < dim; ++g) {
        gradient[a][g] = 1;
        for (int d = 0; d < dim; ++d)
          gradient[a][g] *= d == g ? axes[d].derivative[p[d]] : axes[d].value[p[d]];
      }
    }
  }

 private:
  static std::array<Lagrange1D, dim> evaluate_axes(int degree, const Vec<dim>& xi) {
    if constexpr (dim == 1)
      return {Lagrange1D(degree, xi[0])};
    else if constexpr (dim == 2)
      return {Lagrange1D(degree, xi[0]), Lagrange1D(degree, xi[1])};
    else
      return {Lagrange1D(degree, xi[0]), Lagrange1D(degree, xi[1]), Lagrange1D(degree, xi[2])};
  }
};

/// Second derivative d^2 N_a / dm^2 at xi of the shape function of local node a, for a direction m in the
/// coordinates of the unit cell.
template <int dim>
double shape_second_derivative(int degree, int node, const Vec<dim>& xi, const Vec<dim>& m) {
  const auto p = local_node_position<dim>(degree, node);
  double sum = 0;
  for (int g = 0; g < dim; ++g) {
    for (int h = 0; h < dim; ++h) {
      double term = m[g] * m[h];
      for (int d = 0; d < dim; ++d) {
        const Lagrange1D axis(degree, xi[d]);
        const int order = (d == g) + (d == h);
        term *= order == 0 ? axis.value[p[d]] : order == 1 ? axis.derivative[p[d]] : axis.second[p[d]];
      }
      sum += term;
    }
  }
  return sum;
}

}  // namespace wheelwright
