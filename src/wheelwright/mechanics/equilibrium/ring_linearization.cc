#include "wheelwright/mechanics/equilibrium/ring_linearization.h"

namespace wheelwright {
namespace {

/// Rows of a column's observations in the frames of the contact, with `components` of each point: factor
/// times the displacement and factor times the traction.
template <int dim>
void add_in_contact_frames(const ContactPoints<dim>& at, int column, int components, const Matrix& observed,
                           std::span<const int> trailing, double of_traction, bool by_gamma, Matrix& result) {
  const ObservationRows<dim> rows = at.observation_rows();
  for (int q = 0; q < at.per_column(); ++q) {
    const int i = column * at.per_column() + q;
    const ZonePoint<dim>& point = at.points[i];
    const double of_displacement = by_gamma ? -point.gamma : 1;
    for (int k = 0; k < observed.columns(); ++k) {
      if (trailing[k] < 0) continue;
      Vec<dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = of_displacement * observed(rows.displacement(q) + d, k) +
                   of_traction * observed(rows.traction(q) + d, k);
      value = point.frame.template to_contact<dim>(value);
      for (int c = 0; c < components; ++c) result(components * i + c, trailing[k]) += value[c];
    }
  }
}

}  // namespace

template <int dim>
Expected<std::shared_ptr<const RingLinearization<dim>>> RingLinearization<dim>::at(
    const RingProblem<dim>& problem, const std::vector<double>& v, ContactPoints<dim> zone, int components,
    double tau) {
  SparseSymmetric matrix;
  auto forces = problem.forms.tangent(v, matrix);
  if (!forces.admissible()) return Failure{FailureReason::overload, "material is turned inside out (J <= 0)"};
  const auto trailing = tread_nodes(problem.forms.space(), zone.zone);
  const auto order = problem.orders.with_trailing(trailing);
  auto factor = PartialCholesky::factor(matrix, dim, order.nodes, order.n_trailing);
  if (!factor) {
    if (factor.failure().reason != FailureReason::not_positive_definite) return factor.failure();
    return Failure{FailureReason::not_positive_definite,
                   "the wheel is unstable although its tread is held in the contact zone"};
  }
  auto result = std::shared_ptr<RingLinearization>(new RingLinearization(*std::move(factor)));
  result->forces_ = std::move(forces);
  result->places_.resize(matrix.size);
  for (size_t k = 0; k < order.nodes.size(); ++k)
    for (int c = 0; c < dim; ++c) result->places_[dim * order.nodes[k] + c] = dim * static_cast<int>(k) + c;

  const int n_interior = result->factor_.n_interior(), n_trailing = result->n_trailing();
  Matrix samples(components * zone.size(), n_trailing);
  result->tests_ = Matrix(components * zone.size(), n_trailing);
  for (int c = 0; c < zone.zone.n_columns; ++c) {
    const int column = zone.zone.first_column + c;
    result->observations_.push_back(problem.observer.tangent(v, column));
    std::vector<int> unknowns;
    for (const int dof : problem.observer.dofs(column))
      unknowns.push_back(dof < 0 ? -1 : result->places_[dof] - n_interior);
    result->trailing_.push_back(std::move(unknowns));
    add_in_contact_frames<dim>(zone, c, components, result->observations_.back(), result->trailing_.back(),
                               tau, true, samples);
    add_in_contact_frames<dim>(zone, c, components, result->observations_.back(), result->trailing_.back(), 0,
                               false, result->tests_);
  }
  auto schur_factor = LuFactor::factor(result->schur());
  if (!schur_factor)
    return Failure{FailureReason::not_positive_definite, "the tangent of the wheel is singular"};
  result->schur_factor_ = *std::move(schur_factor);
  Matrix flexibility =
      product(samples, Op::none, result->schur_factor_.solve(transposed(result->tests_)), Op::none);
  result->operator_ = std::make_shared<const ContactOperator<dim>>(
      ContactOperator<dim>{std::move(zone), components, tau, 0, std::move(flexibility)});
  return std::shared_ptr<const RingLinearization>(std::move(result));
}

template <int dim>
Matrix RingLinearization<dim>::eliminated(const Matrix& loads) const {
  auto result = Matrix::unfilled(loads.rows(), loads.columns());
  for (int j = 0; j < loads.columns(); ++j)
    std::copy_n(loads.column(j), loads.rows(), result.column(places_[j]));
  factor_.eliminate(factor_.full_sweep(), result);
  return result;
}

template <int dim>
Matrix RingLinearization<dim>::trailing_displacements(const Matrix& loads) const {
  const Matrix trailing = block(loads, 0, factor_.n_interior(), loads.rows(), n_trailing());
  return transposed(schur_factor_.solve(transposed(trailing)));
}

template <int dim>
Matrix RingLinearization<dim>::displacements(Matrix loads) const {
  const Matrix trailing = trailing_displacements(loads);
  return substituted(std::move(loads), trailing);
}

template <int dim>
Matrix RingLinearization<dim>::extended(const Matrix& trailing) const {
  return substituted(Matrix(trailing.rows(), factor_.size()), trailing);
}

template <int dim>
Matrix RingLinearization<dim>::substituted(Matrix eliminated, const Matrix& trailing) const {
  std::copy(trailing.entries().begin(), trailing.entries().end(), eliminated.column(factor_.n_interior()));
  factor_.substitute(factor_.full_sweep(), eliminated);
  auto result = Matrix::unfilled(eliminated.rows(), eliminated.columns());
  for (int j = 0; j < eliminated.columns(); ++j)
    std::copy_n(eliminated.column(places_[j]), eliminated.rows(), result.column(j));
  return result;
}

template <int dim>
Matrix RingLinearization<dim>::observed(const Matrix& trailing, int row) const {
  Matrix result(operator_->at.observation_rows().n_contact(), zone().n_columns);
  for (int c = 0; c < zone().n_columns; ++c)
    for (int k = 0; k < observations_[c].columns(); ++k)
      if (const int unknown = trailing_[c][k]; unknown >= 0)
        for (int i = 0; i < result.rows(); ++i)
          result(i, c) += observations_[c](i, k) * trailing(row, unknown);
  return result;
}

template <int dim>
void RingLinearization<dim>::add_contact_loads(const Matrix& on_observations, int row, Matrix& loads) const {
  for (int c = 0; c < zone().n_columns; ++c)
    for (int k = 0; k < observations_[c].columns(); ++k)
      if (const int unknown = trailing_[c][k]; unknown >= 0)
        for (int i = 0; i < on_observations.rows(); ++i)
          loads(row, factor_.n_interior() + unknown) += observations_[c](i, k) * on_observations(i, c);
}

template class RingLinearization<2>;

}  // namespace wheelwright
