#include "contact/reduced_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace wheelwright {
namespace {

int wrap(int column, int n_columns) { return (column % n_columns + n_columns) % n_columns; }

/// The core's compliance between the outer-line unknowns of `n_lines` columns from `first_column` on.
template <int dim>
Matrix outer_compliance(const CyclicStiffness<dim>& ring, int per_column, int columns_per_sector,
                        int first_column, int n_columns) {
  const int ring_columns = columns_per_sector * ring.n_sectors();
  Matrix g(per_column * n_columns, per_column * n_columns);
  for (int b = 0; b < n_columns; ++b) {
    const int cb = wrap(first_column + b, ring_columns);
    for (int a = 0; a < n_columns; ++a) {
      const int ca = wrap(first_column + a, ring_columns);
      const Matrix& kernel = ring.outer_compliance(ca / columns_per_sector - cb / columns_per_sector);
      const int i0 = per_column * (ca % columns_per_sector), j0 = per_column * (cb % columns_per_sector);
      for (int j = 0; j < per_column; ++j)
        std::copy_n(kernel.column(j0 + j) + i0, per_column, g.column(per_column * b + j) + per_column * a);
    }
  }
  return g;
}

double squared_norm(const std::vector<double>& v) {
  return std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
}

constexpr int max_newton_iterations = 60;
constexpr double newton_tolerance = 1e-12;

}  // namespace

template <int dim>
ReducedContact<dim>::ReducedContact(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                    const PolarGrid<dim>& grid, GroundPosition ground, ContactZone zone)
    : zone_(zone), friction_(tread.form().friction), tau_(tread.form().tau()), theta_(tread.form().theta()) {
  const double column_angle = grid.cell_size()[1];
  const int per_zone_column = static_cast<int>(tread.points().size()), n_components = components();
  for (int c = 0; c < zone.n_columns; ++c) {
    const double angle = (zone.first_column + c - ground.column - ground.offset) * column_angle;
    for (const auto& point : tread.points()) {
      const Vec<dim> x = rotated<dim>(point.position, angle);
      points_.push_back({x[1], grid.outer_radius - x[0], point.weight, point.gamma, angle});
    }
  }

  // Rows that sample z and rows that test, on a column's observations: S = tau T - gamma U, Te = theta/gamma
  // T - U.
  const int n = n_points() * n_components;
  const auto project = [&](int c, const Matrix& observed, bool sample, Matrix& result, int first_column) {
    for (int q = 0; q < per_zone_column; ++q) {
      const Point& point = points_[c * per_zone_column + q];
      const double of_traction = sample ? tau_ : theta_ / point.gamma,
                   of_displacement = sample ? point.gamma : 1;
      for (int j = 0; j < observed.columns(); ++j) {
        Vec<dim> value;
        for (int d = 0; d < dim; ++d)
          value[d] = of_traction * observed(2 * dim * q + dim + d, j) -
                     of_displacement * observed(2 * dim * q + d, j);
        value = rotated<dim>(value, point.angle);
        for (int d = 0; d < n_components; ++d)
          result((c * per_zone_column + q) * n_components + d, first_column + j) += value[d];
      }
    }
  };

  // F = -S (C + T G T^T) Te^T with the tread's compliance C and transfer T and the core's compliance G.
  const int reach = tread.reach(), per_column = tread.base_per_column();
  const int first_base = zone.first_column - reach, n_base_columns = zone.n_columns + 2 * reach + 1;
  Matrix sample(n, per_column * n_base_columns), test(n, per_column * n_base_columns);
  for (int c = 0; c < zone.n_columns; ++c) {
    for (int d = -reach; d <= reach; ++d) {
      const int base_column = zone.first_column + c - d - first_base;
      project(c, tread.transfer(d), true, sample, per_column * base_column);
      project(c, tread.transfer(d), false, test, per_column * base_column);
    }
  }
  const Matrix g = outer_compliance(ring, per_column, grid.columns(), first_base, n_base_columns);
  const Matrix through_core = product(g, Op::none, test, Op::transpose);
  flexibility_ = Matrix(n, n);
  multiply(-1, sample, Op::none, through_core, Op::none, 0, flexibility_);
  const int block = per_zone_column * n_components;
  for (int from = 0; from < zone.n_columns; ++from) {
    for (int to = 0; to < zone.n_columns; ++to) {
      if (std::abs(to - from) > reach) continue;
      // -S C Te^T by its transposes: the compliance of (to, from) is that of (from, to) transposed.
      Matrix tested(n, tread.n_contact()), columns(tread.n_contact(), block);
      project(from, tread.compliance(from - to), false, tested, 0);
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < columns.rows(); ++i) columns(i, j) = -tested(from * block + j, i);
      project(to, columns, true, flexibility_, from * block);
    }
  }
}

template <int dim>
std::vector<Vec<dim>> ReducedContact<dim>::hertz_start(double load, double radius,
                                                       double reduced_modulus) const {
  const double half_width = 2 * std::sqrt(load * radius / (std::numbers::pi * reduced_modulus));
  const double peak = 2 * load / (std::numbers::pi * half_width);
  std::vector<Vec<dim>> z(points_.size());
  for (size_t i = 0; i < points_.size(); ++i) {
    const double s = points_[i].along / half_width;
    z[i] = {};
    z[i][0] = std::abs(s) < 1 ? -peak * std::sqrt(1 - s * s) : points_[i].gamma * points_[i].gap;
  }
  return z;
}

template <int dim>
std::vector<double> ReducedContact<dim>::residual(const std::vector<Vec<dim>>& z, double rim_displacement,
                                                  double load) const {
  const int nc = components(), n = n_points() * nc;
  Matrix force(n, 1), response(n, 1);
  double balance = load;
  for (int i = 0; i < n_points(); ++i) {
    const auto r = contact_response<dim>(z[i], friction_);
    for (int d = 0; d < nc; ++d) force(nc * i + d, 0) = points_[i].weight * r.traction[d];
    balance += points_[i].weight * r.traction[0];
  }
  multiply(1, flexibility_, Op::none, force, Op::none, 0, response);
  std::vector<double> result(n + 1);
  for (int i = 0; i < n_points(); ++i)
    for (int d = 0; d < nc; ++d)
      result[nc * i + d] = z[i][d] - response(nc * i + d, 0) -
                           (d == 0 ? points_[i].gamma * (points_[i].gap - rim_displacement) : 0.0);
  result[n] = -balance;
  return result;
}

/// The points that carry traction: the columns of all others are unit vectors in the Newton matrix.
template <int dim>
std::vector<int> ReducedContact<dim>::active_rows(const std::vector<Vec<dim>>& z) const {
  const int nc = components();
  std::vector<int> rows;
  for (int i = 0; i < n_points(); ++i)
    if (z[i][0] < 0)
      for (int d = 0; d < nc; ++d) rows.push_back(nc * i + d);
  return rows;
}

/// d(response)/dz, the columns of the active rows: F W Phi', all rows.
template <int dim>
Matrix ReducedContact<dim>::response_tangent(const std::vector<Vec<dim>>& z,
                                             const std::vector<int>& active) const {
  const int nc = components(), n = n_points() * nc;
  Matrix tangent(n, static_cast<int>(active.size()));
  for (int column = 0; column < tangent.columns(); ++column) {
    const int point = active[column] / nc, component = active[column] % nc;
    const auto r = contact_response<dim>(z[point], friction_);
    for (int k = 0; k < nc; ++k) {
      const double weight = points_[point].weight * r.tangent[k][component];
      if (weight == 0) continue;
      const double* f = flexibility_.column(nc * point + k);
      double* t = tangent.column(column);
      for (int i = 0; i < n; ++i) t[i] += weight * f[i];
    }
  }
  return tangent;
}

/// The Newton system on the active rows and the rim's displacement.
template <int dim>
Matrix ReducedContact<dim>::active_system(const std::vector<Vec<dim>>& z, const std::vector<int>& active,
                                          const Matrix& tangent) const {
  const int nc = components(), n = static_cast<int>(active.size());
  Matrix a(n + 1, n + 1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) a(i, j) = (i == j) - tangent(active[i], j);
    const int point = active[j] / nc, component = active[j] % nc;
    a(n, j) = -points_[point].weight * contact_response<dim>(z[point], friction_).tangent[0][component];
    if (component == 0) a(j, n) = points_[point].gamma;
  }
  return a;
}

template <int dim>
std::optional<std::vector<double>> ReducedContact<dim>::newton_step(
    const std::vector<Vec<dim>>& z, const std::vector<double>& residual) const {
  const int nc = components(), n = n_points() * nc;
  const auto active = active_rows(z);
  const int n_active = static_cast<int>(active.size());
  const Matrix tangent = response_tangent(z, active);
  Matrix a = active_system(z, active, tangent), x(n_active + 1, 1);
  for (int i = 0; i < n_active; ++i) x(i, 0) = residual[active[i]];
  x(n_active, 0) = residual[n];
  if (!lu_solve(a, x)) return {};
  std::vector<double> step(residual);
  step[n] = x(n_active, 0);
  for (int j = 0; j < n_active; ++j)
    for (int i = 0; i < n; ++i) step[i] += tangent(i, j) * x(j, 0);
  for (int i = 0; i < n_points(); ++i) step[nc * i] -= points_[i].gamma * step[n];
  for (int i = 0; i < n_active; ++i) step[active[i]] = x(i, 0);
  return step;
}

template <int dim>
Expected<ContactState<dim>> ReducedContact<dim>::solve(double load, std::vector<Vec<dim>> z) const {
  const int nc = components(), n = n_points() * nc;
  double rim = 0, pressure_scale = 0, gamma_scale = 0;
  for (const Point& point : points_) gamma_scale = std::max(gamma_scale, point.gamma);
  for (const auto& value : z) pressure_scale = std::max(pressure_scale, -value[0]);
  if (!(pressure_scale > 0)) return Failure{FailureReason::no_contact, "the start has no point in contact"};

  // Balance and traction equations are compared in the same unit.
  const auto measure = [&](std::vector<double> r) {
    r[n] *= pressure_scale / load;
    return std::sqrt(squared_norm(r));
  };
  double current = measure(residual(z, rim, load));
  for (int iteration = 1; iteration <= max_newton_iterations; ++iteration) {
    const auto step = newton_step(z, residual(z, rim, load));
    if (!step) return Failure{FailureReason::no_contact, "the contact iteration lost all contact"};
    double length = 1;
    std::vector<Vec<dim>> trial = z;
    double trial_rim = rim, reached = 0;
    for (int halving = 0;; ++halving) {
      for (int i = 0; i < n_points(); ++i)
        for (int d = 0; d < nc; ++d) trial[i][d] = z[i][d] - length * (*step)[nc * i + d];
      trial_rim = rim - length * (*step)[n];
      reached = measure(residual(trial, trial_rim, load));
      if (reached < current || halving == 5) break;
      length /= 2;
    }
    if (!std::isfinite(reached)) return Failure{FailureReason::not_finite, "the contact iteration diverged"};
    z = trial;
    rim = trial_rim;
    current = reached;
    if (current <= newton_tolerance * std::sqrt(n) * std::max(pressure_scale, gamma_scale * std::abs(rim))) {
      ContactState<dim> state{zone_, z, {}, rim, iteration};
      for (const auto& value : z) state.traction.push_back(contact_response<dim>(value, friction_).traction);
      return state;
    }
  }
  return Failure{FailureReason::newton_stalled,
                 fmt::format("contact: residual {:.3g} Pa after {} iterations, {} points", current,
                             max_newton_iterations, n_points())};
}

template <int dim>
Matrix ReducedContact<dim>::contact_loads(const ContactState<dim>& state) const {
  const int per_column = n_points() / zone_.n_columns;
  Matrix loads(2 * dim * per_column, zone_.n_columns);
  for (int i = 0; i < n_points(); ++i) {
    const Point& point = points_[i];
    const Vec<dim> traction = rotated<dim>(state.traction[i], -point.angle);
    const int row = 2 * dim * (i % per_column), column = i / per_column;
    for (int d = 0; d < dim; ++d) {
      loads(row + d, column) = point.weight * traction[d];
      loads(row + dim + d, column) = -theta_ / point.gamma * point.weight * traction[d];
    }
  }
  return loads;
}

template <int dim>
Expected<Matrix> ReducedContact<dim>::adjoint_loads(const ContactState<dim>& state,
                                                    const Matrix& observations) const {
  // With Te p = h + F^T m: m - W Phi'^T F^T m + beta W Phi'^T n_y = W Phi'^T h and sum gamma m_n = 0. m
  // vanishes off the active points; on them the matrix is solve()'s, transposed.
  const int nc = components(), per_column = n_points() / zone_.n_columns;
  const auto active = active_rows(state.augmented);
  const int n_active = static_cast<int>(active.size());
  const Matrix forward = active_system(state.augmented, active, response_tangent(state.augmented, active));
  Matrix a(n_active + 1, n_active + 1), m(n_active + 1, 1);
  for (int j = 0; j <= n_active; ++j)
    for (int i = 0; i <= n_active; ++i) a(i, j) = forward(j, i);
  for (int k = 0; k < n_active; ++k) {
    const int i = active[k] / nc, component = active[k] % nc;
    const Point& point = points_[i];
    const int row = 2 * dim * (i % per_column), column = i / per_column;
    Vec<dim> tested;
    for (int d = 0; d < dim; ++d)
      tested[d] = theta_ / point.gamma * observations(row + dim + d, column) - observations(row + d, column);
    tested = rotated<dim>(tested, point.angle);
    const auto r = contact_response<dim>(state.augmented[i], friction_);
    for (int d = 0; d < nc; ++d) m(k, 0) += point.weight * r.tangent[d][component] * tested[d];
  }
  if (!lu_solve(a, m)) return Failure{FailureReason::no_contact, "the adjoint contact system is singular"};

  std::vector<Vec<dim>> multiplier(n_points(), Vec<dim>{});
  for (int k = 0; k < n_active; ++k) multiplier[active[k] / nc][active[k] % nc] = m(k, 0);
  Matrix loads(2 * dim * per_column, zone_.n_columns);
  for (int i = 0; i < n_points(); ++i) {
    const Point& point = points_[i];
    const Vec<dim> value = rotated<dim>(multiplier[i], -point.angle);
    const int row = 2 * dim * (i % per_column), column = i / per_column;
    for (int d = 0; d < dim; ++d) {
      loads(row + d, column) = point.gamma * value[d];
      loads(row + dim + d, column) = -tau_ * value[d];
    }
  }
  return loads;
}

template class ReducedContact<2>;
template class ReducedContact<3>;

}  // namespace wheelwright
