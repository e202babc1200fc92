#include "wheelwright/shape/evolution/spline_level_set.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/evolution/lattice_strides.h"

namespace wheelwright {
namespace {

/// Values along one axis, and how they continue beyond its ends: periodically, or along a straight line.
struct Line {
  std::vector<double> value;
  bool is_periodic;

  int size() const { return static_cast<int>(value.size()); }
  double operator()(int i) const {
    const int n = size();
    if (is_periodic) return value[((i % n) + n) % n];
    if (i < 0) return value[0] + i * (value[1] - value[0]);
    if (i >= n) return value[n - 1] + (i - n + 1) * (value[n - 1] - value[n - 2]);
    return value[i];
  }
};

/// The coefficients of the periodic spline with these values at its knots (M. Unser, A. Aldroubi, M. Eden,
/// IEEE Trans. Signal Process. 41, 1993): the inverse of (1, 4, 1) / 6 has the entries sqrt(3) pole^|k|.
std::vector<double> periodic_coefficients(const Line& value) {
  constexpr int reach = 27;  // pole^27 = 4e-16
  const double pole = std::sqrt(3.0) - 2;
  const int n = value.size();
  std::vector<double> around, result(value.value);
  around.reserve(n + 2 * reach);
  for (int i = -reach; i < n + reach; ++i) around.push_back(value(i));
  const double* middle = around.data() + reach;
  double weight = 1;
  for (int k = 1; k <= reach; ++k) {
    weight *= pole;
    for (int i = 0; i < n; ++i) result[i] += weight * (middle[i + k] + middle[i - k]);
  }
  for (double& sum : result) sum *= std::sqrt(3.0);
  return result;
}

/// The same for a spline that is linear at its ends: there the coefficients are the values.
std::vector<double> bounded_coefficients(const Line& value) {
  const int n = value.size();
  std::vector<double> result = value.value, factor(n);
  for (int i = 1; i + 1 < n; ++i) {
    const double pivot = 4 - factor[i - 1];
    factor[i] = 1 / pivot;
    result[i] = (6 * value(i) - result[i - 1]) / pivot;
  }
  for (int i = n - 2; i > 0; --i) result[i] -= factor[i] * result[i + 1];
  return result;
}

/// Replaces the values on every line of nodes along each axis by function(line of vertices), which has a
/// value for every node.
template <int dim, class Function>
LevelSet<dim> by_lines(LevelSet<dim> psi, Function function) {
  const auto& lattice = psi.lattice;
  for (int axis = 0; axis < dim; ++axis) {
    const int stride = lattice_strides(lattice)[axis], n = lattice.nodes()[axis];
    for (const int first : first_nodes(lattice, axis)) {
      Line vertices{{}, axis == 1};
      vertices.value.reserve(n);
      for (int i = 0; i < n; i += lattice.degree()) vertices.value.push_back(psi.values[first + i * stride]);
      const auto nodes = function(vertices, n);
      for (int i = 0; i < n; ++i) psi.values[first + i * stride] = nodes[i];
    }
  }
  return psi;
}

/// Weights of the vertices i - 1, i, i + 1 and i + 2 halfway between i and i + 1: of Lagrange's polynomial,
/// and of the B-splines.
constexpr double lagrange_outer = -1.0 / 16, lagrange_inner = 9.0 / 16;
constexpr double spline_outer = 1.0 / 48, spline_inner = 23.0 / 48;

double halfway(const Line& line, int i, double outer, double inner) {
  return outer * (line(i - 1) + line(i + 2)) + inner * (line(i) + line(i + 1));
}

std::vector<double> interpolated(const Line& vertices, int n_nodes) {
  std::vector<double> nodes;
  for (int i = 0; i < n_nodes; ++i)
    nodes.push_back(i % 2 == 0 ? vertices(i / 2) : halfway(vertices, i / 2, lagrange_outer, lagrange_inner));
  return nodes;
}

double at_knot(const Line& line, int i) { return (line(i - 1) + line(i + 1) + 4 * line(i)) / 6; }

}  // namespace

template <int dim>
LevelSet<dim> spline_coefficients(const LevelSet<dim>& psi) {
  if (psi.lattice.degree() == 1) return psi;
  return by_lines(psi, [](const Line& values, int n_nodes) {
    auto c = values.is_periodic ? periodic_coefficients(values) : bounded_coefficients(values);
    return interpolated({std::move(c), values.is_periodic}, n_nodes);
  });
}

template <int dim>
LevelSet<dim> spline_level_set(const LevelSet<dim>& coefficients) {
  if (coefficients.lattice.degree() == 1) return coefficients;
  return by_lines(coefficients, [](const Line& c, int n_nodes) {
    std::vector<double> nodes;
    for (int i = 0; i < n_nodes; ++i)
      nodes.push_back(i % 2 == 0 ? at_knot(c, i / 2) : halfway(c, i / 2, spline_outer, spline_inner));
    return nodes;
  });
}

namespace {

/// Weights of the vertices around a cell; vertices beyond the ends of a nonperiodic axis continue a straight
/// line.
std::array<double, 4> within(std::array<double, 4> weight, int cell, int n_vertices, bool is_periodic) {
  const auto continue_linearly = [&](int beyond, int end, int before) {
    weight[end] += 2 * weight[beyond];
    weight[before] -= weight[beyond];
    weight[beyond] = 0;
  };
  if (!is_periodic && cell == 0) continue_linearly(0, 1, 2);
  if (!is_periodic && cell == n_vertices - 2) continue_linearly(3, 2, 1);
  return weight;
}

}  // namespace

std::array<double, 4> spline_weights(int degree, int cell, double xi, int n_vertices, bool is_periodic) {
  const Lagrange1D shape(degree, xi);
  if (degree == 1) return {0, shape.value[0], shape.value[1], 0};
  const auto [first, middle, last] = shape.value;
  return within({first / 6 + spline_outer * middle, 4 * first / 6 + spline_inner * middle + last / 6,
                 first / 6 + spline_inner * middle + 4 * last / 6, spline_outer * middle + last / 6},
                cell, n_vertices, is_periodic);
}

std::array<std::array<double, 4>, 4> spline_derivative_weights(int cell, double xi, int n_vertices,
                                                               bool is_periodic) {
  const double t = xi, s = 1 - xi;
  std::array<std::array<double, 4>, 4> result{{
      {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
       t * t * t / 6},
      {-s * s / 2, -2 * t + 1.5 * t * t, 2 * s - 1.5 * s * s, t * t / 2},
      {s, -2 + 3 * t, -2 + 3 * s, t},
      {-1, 3, -3, 1},
  }};
  for (auto& weight : result) weight = within(weight, cell, n_vertices, is_periodic);
  return result;
}

template <int dim>
void add_dependences(const Lattice<dim>& lattice, const std::array<int, dim>& cell, const Vec<dim>& xi,
                     double factor, std::vector<Dependence>& to) {
  std::array<std::array<double, 4>, dim> weights;
  for (int d = 0; d < dim; ++d)
    weights[d] = spline_weights(lattice.degree(), cell[d], xi[d], lattice.grid().cells[d] + 1, d == 1);
  for (int k = 0; k < power(4, dim); ++k) {
    std::array<int, dim> vertex;
    double weight = factor;
    int rest = k;
    for (int d = 0; d < dim; ++d, rest /= 4) {
      weight *= weights[d][rest % 4];
      vertex[d] = lattice.degree() * (cell[d] + rest % 4 - 1);
    }
    if (weight != 0) to.push_back({lattice.node_index(vertex), weight});
  }
}

template decltype(spline_coefficients<2>) spline_coefficients<2>;
template decltype(spline_level_set<2>) spline_level_set<2>;
template decltype(add_dependences<2>) add_dependences<2>;
template decltype(spline_coefficients<3>) spline_coefficients<3>;
template decltype(spline_level_set<3>) spline_level_set<3>;
template decltype(add_dependences<3>) add_dependences<3>;

}  // namespace wheelwright
