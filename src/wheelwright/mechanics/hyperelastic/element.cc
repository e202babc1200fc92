#include "wheelwright/mechanics/hyperelastic/element.h"

#include <cmath>
#include <limits>
#include <type_traits>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"

namespace wheelwright {
namespace {

/// The integrals over a cell with n nodes, in Cartesian components: [component][node], [i][k][a][b].
template <int dim, int n>
struct Integrals {
  double energy = 0;
  double forces[dim][n] = {};
  double tangent[dim][dim][n][n] = {};
};

enum class Order { energy, forces, tangent };

/// F at a point.
template <int dim, int n>
Mat<dim> deformation_gradient(const typename HyperelasticElement<dim>::Point& point,
                              const typename HyperelasticElement<dim>::Nodal& u) {
  Mat<dim> f;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      double sum = i == j;
      for (int a = 0; a < n; ++a) sum += u[i][a] * point.gradient[j][a];
      f[i][j] = sum;
    }
  return f;
}

/// Adds the integral of a tensor's work on the gradients of the shape functions.
template <int dim, int n>
void add_forces(const typename HyperelasticElement<dim>::Point& point, const Mat<dim>& piola, double weight,
                double (&forces)[dim][n]) {
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      const double value = weight * piola[i][j];
      for (int a = 0; a < n; ++a) forces[i][a] += value * point.gradient[j][a];
    }
}

template <int dim, int n>
void add_tangent(const typename HyperelasticElement<dim>::Point& point, const PiolaTangent<dim>& tangent,
                 double weight, double (&k)[dim][dim][n][n]) {
  for (int i = 0; i < dim; ++i)
    for (int l = i; l < dim; ++l) {
      double column[dim][n];  // A_ijlm dN_b/dx_m
      for (int j = 0; j < dim; ++j) {
        for (int b = 0; b < n; ++b) column[j][b] = 0;
        for (int m = 0; m < dim; ++m) {
          const double value = weight * tangent[dim * i + j][dim * l + m];
          for (int b = 0; b < n; ++b) column[j][b] += value * point.gradient[m][b];
        }
      }
      for (int a = 0; a < n; ++a)
        for (int j = 0; j < dim; ++j) {
          const double gradient = point.gradient[j][a];
          for (int b = 0; b < n; ++b) k[i][l][a][b] += gradient * column[j][b];
        }
    }
}

/// The integrals of ln J times the linear functions, and their derivatives [function][component][node].
template <int dim, int n>
struct VolumeMoments {
  std::array<double, dim + 1> values{};
  double by_nodes[dim + 1][dim][n] = {};
  bool admissible = true;
};

template <int dim, int n>
VolumeMoments<dim, n> volume_moments(const typename HyperelasticElement<dim>::Points& cell,
                                     const typename HyperelasticElement<dim>::Nodal& u, Order order) {
  VolumeMoments<dim, n> moments;
  for (const auto& point : cell.points) {
    const Mat<dim> f = deformation_gradient<dim, n>(point, u);
    const double j = determinant<dim>(f);
    if (!(j > 0)) {
      moments.admissible = false;
      return moments;
    }
    const double log_j = std::log(j);
    for (int alpha = 0; alpha <= dim; ++alpha)
      moments.values[alpha] += point.weight * point.linear[alpha] * log_j;
    if (order == Order::energy) continue;
    const Mat<dim> inverse_f = inverse<dim>(f);
    for (int i = 0; i < dim; ++i) {
      double slope[n] = {};
      for (int l = 0; l < dim; ++l)
        for (int a = 0; a < n; ++a) slope[a] += inverse_f[l][i] * point.gradient[l][a];
      for (int alpha = 0; alpha <= dim; ++alpha) {
        const double weight = point.weight * point.linear[alpha];
        for (int a = 0; a < n; ++a) moments.by_nodes[alpha][i][a] += weight * slope[a];
      }
    }
  }
  return moments;
}

template <int dim>
std::array<double, dim + 1> times(const Matrix& matrix, const std::array<double, dim + 1>& x) {
  std::array<double, dim + 1> result{};
  for (int a = 0; a <= dim; ++a)
    for (int b = 0; b <= dim; ++b) result[a] += matrix(a, b) * x[b];
  return result;
}

/// All integrals up to an order; the energy is infinite if the material is turned inside out somewhere, and
/// then the rest has no meaning.
template <int dim, int n>
Integrals<dim, n> integrate(const StoredEnergy& kept, double projected_lambda,
                            const typename HyperelasticElement<dim>::Points& cell,
                            const typename HyperelasticElement<dim>::Nodal& u, Order order) {
  Integrals<dim, n> result;
  std::array<double, dim + 1> pressure{};  // on the linear functions
  if (projected_lambda > 0) {
    const auto moments = volume_moments<dim, n>(cell, u, order);
    if (!moments.admissible) {
      result.energy = std::numeric_limits<double>::infinity();
      return result;
    }
    pressure = times<dim>(cell.inverse_mass, moments.values);
    for (double& p : pressure) p *= projected_lambda;
    for (int alpha = 0; alpha <= dim; ++alpha) result.energy += 0.5 * pressure[alpha] * moments.values[alpha];
    if (order == Order::tangent)
      for (int alpha = 0; alpha <= dim; ++alpha)
        for (int beta = 0; beta <= dim; ++beta) {
          const double factor = projected_lambda * cell.inverse_mass(alpha, beta);
          for (int i = 0; i < dim; ++i)
            for (int l = i; l < dim; ++l)
              for (int a = 0; a < n; ++a) {
                const double value = factor * moments.by_nodes[alpha][i][a];
                for (int b = 0; b < n; ++b)
                  result.tangent[i][l][a][b] += value * moments.by_nodes[beta][l][b];
              }
        }
  }
  for (const auto& point : cell.points) {
    double p = 0;
    for (int alpha = 0; alpha <= dim; ++alpha) p += pressure[alpha] * point.linear[alpha];
    const auto r = response<dim>(kept, deformation_gradient<dim, n>(point, u), p);
    if (!r.admissible) {
      result.energy = std::numeric_limits<double>::infinity();
      return result;
    }
    result.energy += point.weight * r.energy;
    if (order == Order::energy) continue;
    add_forces<dim, n>(point, r.piola, point.weight, result.forces);
    if (order == Order::tangent) add_tangent<dim, n>(point, r.tangent, point.weight, result.tangent);
  }
  return result;
}

/// Calls f with the number of a cell's nodes as a constant.
template <int dim, class F>
auto with_nodes(int degree, F f) {
  if (degree == 1) return f(std::integral_constant<int, nodes_per_cell<dim>(1)>());
  return f(std::integral_constant<int, nodes_per_cell<dim>(2)>());
}

}  // namespace

template <int dim>
HyperelasticElement<dim>::HyperelasticElement(const PolarGrid<dim>& grid, int degree, int row,
                                              const StoredEnergy& energy, const Material& small_strains,
                                              DilatationKind dilatation)
    : linear_(grid, degree, {row}, IsotropicLaw<dim>(small_strains), dilatation),
      map_(grid, degree, {row}),
      energy_(energy),
      kept_(energy) {
  if (energy.has_logarithmic_volume() && (dim == 3 || energy.plane == Plane::strain))
    projected_lambda_ = linear_.projected_lambda();
  kept_.lambda -= projected_lambda_;
  for (int a = 0; a < n_nodes(); ++a) {
    const double angle = local_node_position<dim>(degree, a)[1] * grid.column_angle() / degree;
    frames_[a] = {};
    for (int c = 0; c < dim; ++c) {
      Vec<dim> unit{};
      unit[c] = 1;
      unit = rotated<dim>(unit, angle);
      for (int i = 0; i < dim; ++i) frames_[a][i][c] = unit[i];
    }
  }
}

template <int dim>
auto HyperelasticElement<dim>::at(const Vec<dim>& xi, double reference_weight) const -> Point {
  const ShapeFunctions<dim> shape(linear_.degree(), xi);
  const Mat<dim> jacobian = map_.jacobian(shape), inverse_jacobian = inverse<dim>(jacobian);
  Point point{.weight = reference_weight * determinant<dim>(jacobian),
              .position = map_.position(shape),
              .gradient = {},
              .value = {},
              .linear = {}};
  for (int a = 0; a < n_nodes(); ++a) {
    const Vec<dim> gradient = transpose_times<dim>(inverse_jacobian, shape.gradient[a]);
    for (int j = 0; j < dim; ++j) point.gradient[j][a] = gradient[j];
    point.value[a] = shape.value[a];
  }
  point.linear = linear_.linear_functions(point.position);
  return point;
}

template <int dim>
auto HyperelasticElement<dim>::points(std::span<const ReferencePoint<dim>> material) const -> Points {
  Points result;
  for (const auto& q : material) result.points.push_back(at(q.xi, q.weight));
  if (projected_lambda_ == 0) return result;
  DilatationMoments<dim> moments(dim + 1);
  for (const Point& point : result.points)
    for (int a = 0; a <= dim; ++a)
      for (int b = 0; b <= dim; ++b) moments.mass(a, b) += point.weight * point.linear[a] * point.linear[b];
  for (int a = 0; a <= dim; ++a) moments.of_dofs(a, a) = 1;
  result.inverse_mass = moments.coefficients();
  return result;
}

template <int dim>
auto HyperelasticElement<dim>::cartesian(const double* dofs) const -> Nodal {
  Nodal u;
  for (int a = 0; a < n_nodes(); ++a)
    for (int i = 0; i < dim; ++i) {
      double sum = 0;
      for (int c = 0; c < dim; ++c) sum += frames_[a][i][c] * dofs[dof(a, c)];
      u[i][a] = sum;
    }
  return u;
}

template <int dim>
void HyperelasticElement<dim>::add_to_dofs(const Nodal& forces, double* dofs) const {
  for (int a = 0; a < n_nodes(); ++a)
    for (int c = 0; c < dim; ++c)
      for (int i = 0; i < dim; ++i) dofs[dof(a, c)] += frames_[a][i][c] * forces[i][a];
}

template <int dim>
Mat<dim> HyperelasticElement<dim>::deformation(const Point& point, const Nodal& u) const {
  return with_nodes<dim>(linear_.degree(), [&](auto n) { return deformation_gradient<dim, n>(point, u); });
}

template <int dim>
double HyperelasticElement<dim>::energy(const Points& points, const double* dofs) const {
  const Nodal u = cartesian(dofs);
  return with_nodes<dim>(linear_.degree(), [&](auto n) {
    return integrate<dim, n>(kept_, projected_lambda_, points, u, Order::energy).energy;
  });
}

template <int dim>
double HyperelasticElement<dim>::forces(const Points& points, const double* dofs, Dofs& forces) const {
  const Nodal u = cartesian(dofs);
  forces.fill(0);
  return with_nodes<dim>(linear_.degree(), [&](auto n) {
    const auto result = integrate<dim, n>(kept_, projected_lambda_, points, u, Order::forces);
    for (int a = 0; a < n; ++a)
      for (int c = 0; c < dim; ++c)
        for (int i = 0; i < dim; ++i) forces[dof(a, c)] += frames_[a][i][c] * result.forces[i][a];
    return result.energy;
  });
}

template <int dim>
double HyperelasticElement<dim>::tangent(const Points& points, const double* dofs, Dofs& forces,
                                         Block& tangent) const {
  const Nodal u = cartesian(dofs);
  forces.fill(0);
  return with_nodes<dim>(linear_.degree(), [&](auto n) {
    const auto result = integrate<dim, n>(kept_, projected_lambda_, points, u, Order::tangent);
    for (int a = 0; a < n; ++a)
      for (int c = 0; c < dim; ++c)
        for (int i = 0; i < dim; ++i) forces[dof(a, c)] += frames_[a][i][c] * result.forces[i][a];
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        double half[dim][dim] = {};  // K_ik R_b
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k) {
            const double value = i <= k ? result.tangent[i][k][a][b] : result.tangent[k][i][b][a];
            for (int d = 0; d < dim; ++d) half[i][d] += value * frames_[b][k][d];
          }
        for (int c = 0; c < dim; ++c)
          for (int d = 0; d < dim; ++d) {
            double sum = 0;
            for (int i = 0; i < dim; ++i) sum += frames_[a][i][c] * half[i][d];
            tangent[size_t(dof(a, c)) * (dim * n) + dof(b, d)] = sum;
          }
      }
    return result.energy;
  });
}

template <int dim>
auto HyperelasticElement<dim>::projected_volume(const Points& points, const double* dofs) const
    -> ProjectedVolume {
  ProjectedVolume result;
  if (projected_lambda_ == 0) return result;
  const Nodal u = cartesian(dofs);
  with_nodes<dim>(linear_.degree(), [&](auto n) {
    const auto moments = volume_moments<dim, n>(points, u, Order::forces);
    result.coefficients = times<dim>(points.inverse_mass, moments.values);
    Matrix by_dofs(dim + 1, dim * n);
    for (int alpha = 0; alpha <= dim; ++alpha)
      for (int a = 0; a < n; ++a)
        for (int c = 0; c < dim; ++c)
          for (int i = 0; i < dim; ++i)
            by_dofs(alpha, dof(a, c)) += frames_[a][i][c] * moments.by_nodes[alpha][i][a];
    result.by_dofs = product(points.inverse_mass, Op::none, by_dofs, Op::none);
    return 0;
  });
  return result;
}

template <int dim>
auto HyperelasticElement<dim>::traction_tangent(const Point& point, const EnergyResponse<dim>& at,
                                                const Mat<dim>& f, const ProjectedVolume& volume,
                                                const Vec<dim>& normal) const -> std::array<Dofs, dim> {
  std::array<Dofs, dim> result{};
  for (int i = 0; i < dim; ++i) {
    Mat<dim> by_f{};  // d(P n)_i / dF
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l) by_f[k][l] += normal[j] * at.tangent[dim * i + j][dim * k + l];
    add_work(point, by_f, 1, result[i].data());
  }
  if (projected_lambda_ == 0) return result;
  const Vec<dim> area = transpose_times<dim>(inverse<dim>(f), normal);  // F^-T n
  for (int k = 0; k < n_dofs(); ++k) {
    double pressure = 0;
    for (int a = 0; a <= dim; ++a) pressure += projected_lambda_ * point.linear[a] * volume.by_dofs(a, k);
    for (int i = 0; i < dim; ++i) result[i][k] += pressure * area[i];
  }
  return result;
}

template <int dim>
void HyperelasticElement<dim>::add_work(const Point& point, const Mat<dim>& piola, double factor,
                                        double* dofs) const {
  Nodal forces{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int a = 0; a < n_nodes(); ++a) forces[i][a] += factor * piola[i][j] * point.gradient[j][a];
  add_to_dofs(forces, dofs);
}

template <int dim>
Matrix gradient_ghost_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                                double angle, double modulus, const GhostPenalty& ghost) {
  const int n_minus = minus.n_dofs(), n = n_minus + plus.n_dofs();
  const double h = 0.5 * (minus.size_across(axis) + plus.size_across(axis));
  Matrix k(n, n);
  std::vector<double> jump(n);
  const auto add = [&](const auto& of_minus, const auto& of_plus, double weight) {
    for (int d = 0; d < dim; ++d) {
      for (int j = 0; j < n_minus; ++j) jump[j] = -of_minus[d][j];
      for (int j = n_minus; j < n; ++j) {
        Vec<dim> column;
        for (int i = 0; i < dim; ++i) column[i] = of_plus[i][j - n_minus];
        jump[j] = rotated<dim>(column, angle)[d];
      }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) k(i, j) += weight * jump[i] * jump[j];
    }
  };
  const auto normal_derivative = [](const ElasticElement<dim>& element, const Vec<dim>& xi,
                                    const Vec<dim>& normal) {
    const auto gradient = element.gradient(xi);
    std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> result{};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int dof = 0; dof < element.n_dofs(); ++dof)
          result[i][dof] += normal[j] * gradient[dim * i + j][dof];
    return result;
  };
  for (const auto& q : unit_cell_rule<dim - 1>(minus.degree() + 1)) {
    Vec<dim> xi_minus, xi_plus, reference_normal{};
    for (int d = 0, f = 0; d < dim; ++d) {
      xi_minus[d] = d == axis ? 1 : q.xi[f];
      xi_plus[d] = d == axis ? 0 : q.xi[f];
      if (d != axis) ++f;
    }
    reference_normal[axis] = 1;
    const auto surface = map_surface<dim>(minus.at(xi_minus).jacobian, reference_normal);
    const Vec<dim> normal = surface.normal, plus_normal = rotated<dim>(normal, -angle);
    const double weight = 0.5 * ghost.xi * q.weight * surface.scale * modulus;
    add(normal_derivative(minus, xi_minus, normal), normal_derivative(plus, xi_plus, plus_normal),
        weight * h);
    if (n_compared_derivatives(ghost, minus.degree()) > 1)
      add(minus.second_derivative(xi_minus, axis, normal), plus.second_derivative(xi_plus, axis, plus_normal),
          weight * h * h * h);
  }
  return k;
}

#define WHEELWRIGHT_INSTANTIATE(dim)       \
  template class HyperelasticElement<dim>; \
  template decltype(gradient_ghost_stiffness<dim>) gradient_ghost_stiffness<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
