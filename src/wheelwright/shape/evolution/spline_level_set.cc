#include "wheelwright/shape/evolution/spline_level_set.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/evolution/lattice_strides.h"

namespace wheelwright {
namespace {

template <int dim>
bool has_unequal_cells(const PolarGrid<dim>& grid, int axis) {
  return axis == 0 && !grid.fixed_lines.empty();
}

/// The height of a row [m]. Rows continue beyond rim and tread with equal heights.
template <int dim>
double height(const PolarGrid<dim>& grid, int row) {
  return grid.row_height(std::clamp(row, 0, grid.cells[0] - 1));
}

// The spline on unequal rows (W. Boehm, Computer Aided Design 12, 1980): the inner Bezier points of a row
// divide the leg between its two control points as the row divides itself and its neighbours, and the point
// at a vertex, where the slope is continuous, divides the way between the inner points beside it as the
// heights do.

/// The fractions of the leg of a row at which its inner Bezier points lie.
template <int dim>
std::array<double, 2> inner_points(const PolarGrid<dim>& grid, int row) {
  const double all = height(grid, row - 1) + height(grid, row) + height(grid, row + 1);
  return {height(grid, row - 1) / all, (height(grid, row - 1) + height(grid, row)) / all};
}

/// The weights of the control points of vertex - 1, vertex and vertex + 1 in the value at a vertex.
template <int dim>
std::array<double, 3> at_vertex(const PolarGrid<dim>& grid, int vertex) {
  if (vertex == 0 || vertex == grid.cells[0]) return {0, 1, 0};
  const double inside = height(grid, vertex - 1), outside = height(grid, vertex), both = inside + outside;
  const double first = outside / both * (1 - inner_points(grid, vertex - 1)[1]),
               last = inside / both * inner_points(grid, vertex)[0];
  return {first, 1 - first - last, last};
}

/// The weights of the coefficients of vertex - 1, vertex and vertex + 1 in the control point of a vertex.
template <int dim>
std::array<double, 3> control_point(const PolarGrid<dim>& grid, int vertex) {
  if (vertex == 0 || vertex == grid.cells[0]) return {0, 1, 0};
  const double inside = height(grid, vertex - 1), outside = height(grid, vertex),
               share = std::abs(outside - inside) / (3 * std::max(inside, outside));
  return outside > inside ? std::array{0.0, 1 - share, share} : std::array{share, 1 - share, 0.0};
}

/// Values along one axis, and how they continue beyond its ends: periodically, or along a straight line.
struct Line {
  std::vector<double> value;
  int axis;

  int size() const { return static_cast<int>(value.size()); }
  bool is_periodic() const { return axis == 1; }
  double operator()(int i) const {
    const int n = size();
    if (is_periodic()) return value[((i % n) + n) % n];
    if (i < 0) return value[0] + i * (value[1] - value[0]);
    if (i >= n) return value[n - 1] + (i - n + 1) * (value[n - 1] - value[n - 2]);
    return value[i];
  }
};

/// x with weights(i) . (x_(i-1), x_i, x_(i+1)) = right_i, by Gaussian elimination without pivoting.
template <class Weights>
std::vector<double> solved(Weights weights, std::vector<double> right) {
  const int n = static_cast<int>(right.size());
  std::vector<double> factor(n);
  for (int i = 0; i < n; ++i) {
    const auto [before, at, after] = weights(i);
    const double pivot = at - (i > 0 ? before * factor[i - 1] : 0);
    factor[i] = after / pivot;
    right[i] = (right[i] - (i > 0 ? before * right[i - 1] : 0)) / pivot;
  }
  for (int i = n - 2; i >= 0; --i) right[i] -= factor[i] * right[i + 1];
  return right;
}

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

/// The same on unequal rows.
template <int dim>
std::vector<double> unequal_coefficients(const PolarGrid<dim>& grid, std::vector<double> value) {
  auto control_points = solved([&](int i) { return at_vertex(grid, i); }, std::move(value));
  return solved([&](int i) { return control_point(grid, i); }, std::move(control_points));
}

/// Replaces the values on every line of nodes along each axis by function(line of vertices), which has a
/// value for every node.
template <int dim, class Function>
LevelSet<dim> by_lines(LevelSet<dim> psi, Function function) {
  const auto& lattice = psi.lattice;
  for (int axis = 0; axis < dim; ++axis) {
    const int stride = lattice_strides(lattice)[axis], n = lattice.nodes()[axis];
    for (const int first : first_nodes(lattice, axis)) {
      Line vertices{{}, axis};
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

/// The cubic through the values of the nearest four vertices, or fewer, halfway between i and i + 1.
template <int dim>
double cubic_halfway(const PolarGrid<dim>& grid, const Line& value, int i) {
  const int first = std::max(i - 1, 0), last = std::min(i + 2, grid.cells[0]);
  std::array<double, 4> place;  // from halfway
  for (int vertex = first; vertex <= last; ++vertex)
    place[vertex - first] = vertex < i        ? -0.5 * height(grid, i) - height(grid, i - 1)
                            : vertex == i     ? -0.5 * height(grid, i)
                            : vertex == i + 1 ? 0.5 * height(grid, i)
                                              : 0.5 * height(grid, i) + height(grid, i + 1);
  double sum = 0;
  for (int a = 0; a <= last - first; ++a) {
    double weight = 1;
    for (int b = 0; b <= last - first; ++b)
      if (b != a) weight *= place[b] / (place[b] - place[a]);
    sum += weight * value(first + a);
  }
  return sum;
}

template <int dim>
std::vector<double> interpolated(const PolarGrid<dim>& grid, const Line& vertices, int n_nodes) {
  std::vector<double> nodes;
  for (int i = 0; i < n_nodes; ++i)
    nodes.push_back(i % 2 == 0 ? vertices(i / 2) : cubic_halfway(grid, vertices, i / 2));
  return nodes;
}

/// The values of the spline on unequal rows at the nodes.
template <int dim>
std::vector<double> unequal_spline(const PolarGrid<dim>& grid, const std::vector<double>& coefficients,
                                   int n_nodes) {
  const auto combined = [](const std::array<double, 3>& weights, const std::vector<double>& x, int i) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      if (weights[k] != 0) sum += weights[k] * x[i + k - 1];
    return sum;
  };
  std::vector<double> control_points, nodes;
  for (int i = 0; i <= grid.cells[0]; ++i)
    control_points.push_back(combined(control_point(grid, i), coefficients, i));
  for (int i = 0; i < n_nodes; ++i) {
    const int row = i / 2;
    if (i % 2 == 0) {
      nodes.push_back(combined(at_vertex(grid, row), control_points, row));
      continue;
    }
    const auto [first, second] = inner_points(grid, row);
    const double inner =
        std::lerp(control_points[row], control_points[row + 1], 0.5 * (first + second));  // mean of both
    nodes.push_back(0.75 * inner + 0.125 * (combined(at_vertex(grid, row), control_points, row) +
                                            combined(at_vertex(grid, row + 1), control_points, row + 1)));
  }
  return nodes;
}

}  // namespace

template <int dim>
LevelSet<dim> spline_coefficients(const LevelSet<dim>& psi) {
  if (psi.lattice.degree() == 1) return psi;
  const PolarGrid<dim>& grid = psi.lattice.grid();
  return by_lines(psi, [&](const Line& values, int n_nodes) {
    if (has_unequal_cells(grid, values.axis))
      return interpolated(grid, {unequal_coefficients(grid, values.value), 0}, n_nodes);
    auto c = values.is_periodic() ? periodic_coefficients(values) : bounded_coefficients(values);
    return interpolated({std::move(c), values.axis}, n_nodes);
  });
}

template <int dim>
LevelSet<dim> spline_level_set(const LevelSet<dim>& coefficients) {
  if (coefficients.lattice.degree() == 1) return coefficients;
  const PolarGrid<dim>& grid = coefficients.lattice.grid();
  return by_lines(coefficients, [&](const Line& c, int n_nodes) {
    if (has_unequal_cells(grid, c.axis)) return unequal_spline(grid, c.value, n_nodes);
    std::vector<double> nodes;
    for (int i = 0; i < n_nodes; ++i)
      nodes.push_back(i % 2 == 0 ? at_knot(c, i / 2) : halfway(c, i / 2, spline_outer, spline_inner));
    return nodes;
  });
}

namespace {

/// Weights of the vertices around a cell; vertices beyond the ends of a nonperiodic axis continue a straight
/// line.
SplineWeights within(SplineWeights weight, int cell, int n_cells, bool is_periodic) {
  const auto continue_linearly = [&](int beyond, int end, int before) {
    weight[end] += 2 * weight[beyond];
    weight[before] -= weight[beyond];
    weight[beyond] = 0;
  };
  if (!is_periodic && cell == 0) continue_linearly(0, 1, 2);
  if (!is_periodic && cell == n_cells - 1) continue_linearly(3, 2, 1);
  return weight;
}

/// The weights of the vertices row - 2 to row + 3 in the combination of a row's Bezier points with these
/// weights.
template <int dim>
SplineWeights of_bezier_points(const PolarGrid<dim>& grid, int row, const std::array<double, 4>& of_points) {
  SplineWeights of_control_points{}, result{};
  const auto add = [](SplineWeights& to, int middle, double factor, const std::array<double, 3>& weights) {
    for (int k = 0; k < 3; ++k)
      if (weights[k] != 0) to[middle + k - 1] += factor * weights[k];
  };
  add(of_control_points, 2, of_points[0], at_vertex(grid, row));
  add(of_control_points, 3, of_points[3], at_vertex(grid, row + 1));
  const auto shares = inner_points(grid, row);
  for (int k = 0; k < 2; ++k) {
    of_control_points[2] += of_points[1 + k] * (1 - shares[k]);
    of_control_points[3] += of_points[1 + k] * shares[k];
  }
  for (int k = 1; k < 5; ++k)
    if (of_control_points[k] != 0) add(result, k, of_control_points[k], control_point(grid, row - 2 + k));
  return result;
}

}  // namespace

template <int dim>
SplineSupport spline_support(const PolarGrid<dim>& grid, int axis, int cell) {
  return has_unequal_cells(grid, axis) ? SplineSupport{cell - 2, 6} : SplineSupport{cell - 1, 4};
}

template <int dim>
SplineWeights spline_weights(const PolarGrid<dim>& grid, int degree, int axis, int cell, double xi) {
  const Lagrange1D shape(degree, xi);
  if (degree == 1)
    return has_unequal_cells(grid, axis) ? SplineWeights{0, 0, shape.value[0], shape.value[1]}
                                         : SplineWeights{0, shape.value[0], shape.value[1]};
  const auto [first, middle, last] = shape.value;
  if (has_unequal_cells(grid, axis))
    return of_bezier_points(grid, cell,
                            {first + middle / 8, 3 * middle / 8, 3 * middle / 8, last + middle / 8});
  return within({first / 6 + spline_outer * middle, 4 * first / 6 + spline_inner * middle + last / 6,
                 first / 6 + spline_inner * middle + 4 * last / 6, spline_outer * middle + last / 6},
                cell, grid.cells[axis], axis == 1);
}

template <int dim>
std::array<SplineWeights, 4> spline_derivative_weights(const PolarGrid<dim>& grid, int axis, int cell,
                                                       double xi) {
  const double t = xi, s = 1 - xi;
  std::array<SplineWeights, 4> result;
  if (has_unequal_cells(grid, axis)) {
    const std::array<std::array<double, 4>, 4> of_points{
        {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
         {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t},
         {6 * s, 6 * t - 12 * s, 6 * s - 12 * t, 6 * t},
         {-6, 18, -18, 6}}};
    for (int order = 0; order < 4; ++order) result[order] = of_bezier_points(grid, cell, of_points[order]);
    return result;
  }
  result = {{
      {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
       t * t * t / 6},
      {-s * s / 2, -2 * t + 1.5 * t * t, 2 * s - 1.5 * s * s, t * t / 2},
      {s, -2 + 3 * t, -2 + 3 * s, t},
      {-1, 3, -3, 1},
  }};
  for (auto& weight : result) weight = within(weight, cell, grid.cells[axis], axis == 1);
  return result;
}

namespace {

/// The coefficients along one axis on which something depends.
struct AxisDependence {
  SplineSupport support;
  SplineWeights weights;
};

template <int dim>
void add_products(const Lattice<dim>& lattice, const std::array<AxisDependence, dim>& along, double factor,
                  std::vector<Dependence>& to) {
  int total = 1;
  for (const AxisDependence& axis : along) total *= axis.support.count;
  for (int k = 0; k < total; ++k) {
    std::array<int, dim> vertex;
    double weight = factor;
    int rest = k;
    for (int d = 0; d < dim; ++d) {
      const int i = rest % along[d].support.count;
      rest /= along[d].support.count;
      weight *= along[d].weights[i];
      vertex[d] = lattice.degree() * (along[d].support.first + i);
    }
    if (weight != 0) to.push_back({lattice.node_index(vertex), weight});
  }
}

/// The weights of the control point at a node of a cell, along one axis.
template <int dim>
SplineWeights control_point_weights(const PolarGrid<dim>& grid, int degree, int axis, int cell, double xi) {
  auto weights = spline_weights(grid, degree, axis, cell, xi);
  if (xi != 0.5) return weights;
  const auto first = spline_weights(grid, degree, axis, cell, 0.0),
             last = spline_weights(grid, degree, axis, cell, 1.0);
  for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = 2 * weights[k] - 0.5 * (first[k] + last[k]);
  return weights;
}

}  // namespace

template <int dim>
void add_dependences(const Lattice<dim>& lattice, const std::array<int, dim>& cell, const Vec<dim>& xi,
                     double factor, std::vector<Dependence>& to) {
  std::array<AxisDependence, dim> along;
  for (int d = 0; d < dim; ++d)
    along[d] = {spline_support(lattice.grid(), d, cell[d]),
                spline_weights(lattice.grid(), lattice.degree(), d, cell[d], xi[d])};
  add_products<dim>(lattice, along, factor, to);
}

template <int dim>
std::vector<Dependence> control_point_dependence(const Lattice<dim>& lattice, int node) {
  const int degree = lattice.degree();
  const auto place = lattice.node_position(node);
  std::array<AxisDependence, dim> along;
  for (int d = 0; d < dim; ++d) {
    const int cell = std::min(place[d] / degree, lattice.grid().cells[d] - 1);
    along[d] = {spline_support(lattice.grid(), d, cell),
                control_point_weights(lattice.grid(), degree, d, cell,
                                      static_cast<double>(place[d] - degree * cell) / degree)};
  }
  std::vector<Dependence> result;
  add_products<dim>(lattice, along, 1, result);
  return result;
}

template decltype(spline_support<2>) spline_support<2>;
template decltype(spline_weights<2>) spline_weights<2>;
template decltype(spline_derivative_weights<2>) spline_derivative_weights<2>;
template decltype(spline_support<3>) spline_support<3>;
template decltype(spline_weights<3>) spline_weights<3>;
template decltype(spline_derivative_weights<3>) spline_derivative_weights<3>;
template decltype(spline_coefficients<2>) spline_coefficients<2>;
template decltype(spline_level_set<2>) spline_level_set<2>;
template decltype(add_dependences<2>) add_dependences<2>;
template decltype(control_point_dependence<2>) control_point_dependence<2>;
template decltype(control_point_dependence<3>) control_point_dependence<3>;
template decltype(spline_coefficients<3>) spline_coefficients<3>;
template decltype(spline_level_set<3>) spline_level_set<3>;
template decltype(add_dependences<3>) add_dependences<3>;

}  // namespace wheelwright
