#include "wheelwright/shape/evolution/closest_point.h"

#include <utility>

namespace wheelwright {

namespace {

constexpr int max_newton_steps = 10;
/// Tolerance on the length of the last step, in node spacings. The error is about the square of this length.
constexpr double tolerance = 1e-5;

template <int dim>
double shortest_spacing(const Lattice<dim>& lattice) {
  return lattice.grid().resolution() / lattice.degree();
}

/// The vector from a to b in the orthonormal polar frame at a.
template <int dim>
Vec<dim> difference(const Lattice<dim>& lattice, const Vec<dim>& a, const Vec<dim>& b) {
  const double angle = (b[1] - a[1]) * lattice.node_angle(), radius = lattice.radius(b[0]);
  const double half_sine = std::sin(angle / 2);
  Vec<dim> result;
  result[0] = lattice.radial_distance(a[0], b[0]) - 2 * radius * half_sine * half_sine;
  result[1] = radius * std::sin(angle);
  if constexpr (dim == 3) result[2] = (b[2] - a[2]) * (lattice.grid().axial_size() / lattice.degree());
  return result;
}

/// The point a + step, with the step given in the orthonormal polar frame at a.
template <int dim>
Vec<dim> moved(const Lattice<dim>& lattice, const Vec<dim>& a, const Vec<dim>& step) {
  const double along = lattice.radius(a[0]) + step[0];
  Vec<dim> result;
  result[0] = lattice.place_at(std::hypot(along, step[1]));
  result[1] = a[1] + std::atan2(step[1], along) / lattice.node_angle();
  if constexpr (dim == 3) result[2] = a[2] + step[2] / (lattice.grid().axial_size() / lattice.degree());
  return result;
}

template <int dim>
bool inside(const Lattice<dim>& lattice, const Vec<dim>& point) {
  constexpr double slack = 1e-6;
  for (int d = 0; d < dim; ++d)
    if (d != 1 && !(point[d] >= -slack && point[d] <= lattice.nodes()[d] - 1 + slack)) return false;
  return true;
}

/// Solves an n x n system by Gaussian elimination with partial pivoting. The result is undefined if the
/// matrix is singular.
template <int n>
Vec<n> solve(Mat<n> m, Vec<n> b) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    std::swap(m[k], m[pivot]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (int j = k; j < n; ++j) m[i][j] -= factor * m[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= m[k][j] * b[j];
    b[k] /= m[k][k];
  }
  return b;
}

/// The Newton step towards a stationary point of the Lagrangian; `to_target` = target - x.
template <int dim>
Vec<dim> lagrange_step(const Jet<dim>& jet, const Vec<dim>& to_target) {
  const double slope2 = dot<dim>(jet.gradient, jet.gradient);
  const double slope = std::sqrt(slope2);
  const double multiplier = dot<dim>(to_target, jet.gradient) / slope2;
  Mat<dim + 1> matrix{};
  Vec<dim + 1> right{};
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) matrix[i][j] = (i == j) + multiplier * jet.hessian[i][j];
    matrix[i][dim] = matrix[dim][i] = jet.gradient[i] / slope;
    right[i] = to_target[i];
  }
  right[dim] = -jet.value / slope;
  const auto solution = solve<dim + 1>(matrix, right);
  Vec<dim> step;
  for (int d = 0; d < dim; ++d) step[d] = solution[d];
  return step;
}

}  // namespace

template <int dim>
double physical_distance(const Lattice<dim>& lattice, const Vec<dim>& a, const Vec<dim>& b) {
  return norm<dim>(difference<dim>(lattice, a, b));
}

template <int dim>
std::optional<Vec<dim>> project_to_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& start) {
  const auto& lattice = psi.lattice();
  const double spacing = shortest_spacing(lattice);
  Vec<dim> x = start;
  for (int k = 0; k < max_newton_steps; ++k) {
    const Jet<dim> jet = psi(x);
    const double slope2 = dot<dim>(jet.gradient, jet.gradient);
    const Vec<dim> step = -jet.value / slope2 * jet.gradient;
    const double length = norm<dim>(step);
    if (!(length < spacing)) return std::nullopt;
    x = moved<dim>(lattice, x, step);
    if (!inside<dim>(lattice, x) || physical_distance<dim>(lattice, start, x) > spacing) return std::nullopt;
    if (length < tolerance * spacing) return x;
  }
  return std::nullopt;
}

template <int dim>
std::optional<Vec<dim>> closest_zero(const CubicInterpolant<dim>& psi, const Vec<dim>& target,
                                     const Vec<dim>& seed) {
  const auto& lattice = psi.lattice();
  const double spacing = shortest_spacing(lattice);
  Vec<dim> x = seed;
  for (int k = 0; k < max_newton_steps; ++k) {
    const Vec<dim> step = lagrange_step<dim>(psi(x), difference<dim>(lattice, x, target));
    const double length = norm<dim>(step);
    if (!(length < spacing)) return std::nullopt;
    x = moved<dim>(lattice, x, step);
    if (!inside<dim>(lattice, x) || physical_distance<dim>(lattice, seed, x) > spacing) return std::nullopt;
    if (length > tolerance * spacing) continue;
    const double slack = 1e-6 * spacing;
    if (physical_distance<dim>(lattice, target, x) > physical_distance<dim>(lattice, target, seed) + slack)
      return std::nullopt;
    return x;
  }
  return std::nullopt;
}

template decltype(physical_distance<2>) physical_distance<2>;
template decltype(physical_distance<3>) physical_distance<3>;
template decltype(project_to_zero<2>) project_to_zero<2>;
template decltype(project_to_zero<3>) project_to_zero<3>;
template decltype(closest_zero<2>) closest_zero<2>;
template decltype(closest_zero<3>) closest_zero<3>;

}  // namespace wheelwright
