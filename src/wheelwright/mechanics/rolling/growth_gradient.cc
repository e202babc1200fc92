#include "wheelwright/mechanics/rolling/growth_gradient.h"

#include <algorithm>
#include <numeric>

#include "wheelwright/mechanics/rolling/radius_gradient.h"
#include "wheelwright/mechanics/rolling/topological_derivative.h"

namespace wheelwright {
namespace {

/// dJ_i / d(growth) of every position. With a prescribed travel the rim's motion towards the ground is the
/// travel less the mean growth.
template <int dim>
std::vector<double> by_growth(const RollingSolution<dim>& s, const FunctionalDerivative<dim>& function,
                              const Adjoint& adjoint) {
  std::vector<double> factors(s.positions.size(), 0.0);
  if (!function.growth.empty()) factors = function.growth;
  if (!s.model.travel) return factors;
  const auto& m = s.positions.multiplicities;
  const double mean = std::inner_product(m.begin(), m.end(), adjoint.by_travel.begin(), 0.0) /
                      std::accumulate(m.begin(), m.end(), 0.0);
  for (double& factor : factors) factor -= mean;
  return factors;
}

/// The derivatives of all functions with respect to the observations of the wheel without load. Empty if none
/// of them depends on growth.
template <int dim>
std::vector<FunctionalDerivative<dim>> by_states_without_load(
    const RollingSolution<dim>& s, std::span<const FunctionalDerivative<dim>> functions,
    std::span<const Adjoint> adjoints, ObservationRows<dim> rows) {
  if (s.standing.empty()) return {};
  std::vector<FunctionalDerivative<dim>> result;
  bool any = false;
  const int n_columns = s.observations.columns() / s.positions.size();
  for (size_t f = 0; f < functions.size(); ++f) {
    const auto factors = by_growth(s, functions[f], adjoints[f]);
    any = any || std::ranges::any_of(factors, [](double factor) { return factor != 0; });
    Matrix loads(s.observations.rows(), s.observations.columns());
    for (int i = 0; i < s.positions.size(); ++i) {
      const StandingPoint<dim>& at = s.standing[i];
      // By which the rim sinks when the point moves: along the normal, over its part along n_y.
      Vec<dim> down{};
      down[0] = 1 / std::cos(at.frame.tilt);
      down = at.frame.template contact_to_body<dim>(down);
      for (int d = 0; d < dim; ++d)
        loads(rows.displacement(at.point) + d, i * n_columns + at.column) = -factors[i] * down[d];
    }
    result.push_back({.tread_loads = std::move(loads)});
  }
  if (!any) result.clear();
  return result;
}

void add(const std::vector<std::vector<double>>& term, std::vector<std::vector<double>>& sum) {
  for (size_t f = 0; f < sum.size(); ++f)
    for (size_t i = 0; i < sum[f].size(); ++i) sum[f][i] += term[f][i];
}

}  // namespace

template <int dim>
std::optional<Failure> add_growth(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                                  std::span<const FunctionalDerivative<dim>> functions,
                                  std::span<const Adjoint> adjoints, ShapeGradients& gradients) {
  const auto derivatives = by_states_without_load(s, functions, adjoints, problem.tread().observation_rows());
  if (derivatives.empty()) return {};
  const auto unloaded = problem.without_load(s);
  if (!unloaded) return unloaded.failure();
  const auto of_growth = adjoint_gradients<dim>(problem, *unloaded, derivatives);
  if (!of_growth) return of_growth.failure();
  add(of_growth->gradients.densities, gradients.densities);
  add(of_growth->gradients.edge_densities, gradients.edge_densities);
  add(of_growth->gradients.by_radius, gradients.by_radius);
  return {};
}

template <int dim>
std::optional<Failure> add_growth(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                                  std::span<const FunctionalDerivative<dim>> functions,
                                  std::span<const Adjoint> adjoints,
                                  std::span<const MaterialPoint<dim>> points,
                                  std::vector<std::vector<double>>& result) {
  const auto derivatives = by_states_without_load(s, functions, adjoints, problem.tread().observation_rows());
  if (derivatives.empty()) return {};
  const auto unloaded = problem.without_load(s);
  if (!unloaded) return unloaded.failure();
  const auto of_growth = topological_derivatives<dim>(problem, *unloaded, derivatives, points);
  if (!of_growth) return of_growth.failure();
  add(*of_growth, result);
  return {};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                       \
  template std::optional<Failure> add_growth(const RollingProblem<dim>&, const RollingSolution<dim>&,      \
                                             std::span<const FunctionalDerivative<dim>>,                   \
                                             std::span<const Adjoint>, ShapeGradients&);                   \
  template std::optional<Failure> add_growth(                                                              \
      const RollingProblem<dim>&, const RollingSolution<dim>&, std::span<const FunctionalDerivative<dim>>, \
      std::span<const Adjoint>, std::span<const MaterialPoint<dim>>, std::vector<std::vector<double>>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
