#include "wheelwright/sensitivity/evaluate.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/analysis/rolling_measures.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/functionals/mean_contact_stress.h"
#include "wheelwright/rolling/adjoint.h"
#include "wheelwright/rolling/shape_gradient.h"

namespace wheelwright {
namespace {

/// sum += weight * term, where an empty matrix is zero.
void accumulate(double weight, const Matrix& term, Matrix& sum) {
  if (term.rows() == 0) return;
  if (sum.rows() == 0) sum = Matrix(term.rows(), term.columns());
  for (size_t k = 0; k < term.entries().size(); ++k) sum.entries()[k] += weight * term.entries()[k];
}

template <int dim>
std::vector<MeasureValue> measures(const RollingSolution<dim>& solution) {
  std::vector<ContactSummary> positions;
  for (size_t i = 0; i < solution.contacts.size(); ++i)
    positions.insert(positions.end(), static_cast<size_t>(solution.positions.multiplicities[i]),
                     contact_summary(solution.contacts[i], solution.states[i]));
  const RollingMeasures m = rolling_measures(positions);
  std::vector<MeasureValue> values;
  for (const auto& [quantity, member] : rolling_quantities)
    values.push_back({std::string(name(quantity)), m.*member});
  return values;
}

}  // namespace

template <int dim>
Expected<Evaluation<dim>> differentiate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                        const RollingSolution<dim>& solution, const Matrix* held_mean) {
  Evaluation<dim> evaluation{
      0, {}, {}, {}, mean_observations(problem, solution), solution.phases, measures(solution)};
  Stopwatch watch;
  AdjointLoads loads;
  for (const auto& [weight, criterion] : criteria) {
    const CriterionTerm term =
        criterion->evaluate(problem, solution, held_mean ? *held_mean : evaluation.mean_observations);
    evaluation.criteria.push_back({criterion->name(), term.value(solution.positions)});
    evaluation.objective += weight * evaluation.criteria.back().value;
    loads.state_weight += weight * term.loads.state_weight;
    loads.ghost_weight += weight * term.loads.ghost_weight;
    accumulate(weight, term.loads.observations, loads.observations);
  }
  for (const auto& state : solution.states) evaluation.newton_iterations.push_back(state.newton_iterations);
  evaluation.phases.push_back({phase::criteria, watch.lap()});

  const auto adjoint = solve_adjoint(problem, solution, loads);
  if (!adjoint) return adjoint.failure();
  evaluation.phases.push_back({phase::adjoint, watch.lap()});
  evaluation.gradient = shape_gradient(problem, criteria, solution, *adjoint);
  evaluation.phases.push_back({phase::gradient, watch.lap()});
  if (!std::isfinite(evaluation.objective) ||
      !std::all_of(evaluation.gradient.begin(), evaluation.gradient.end(),
                   [](const auto& sample) { return std::isfinite(sample.value); }))
    return Failure{FailureReason::not_finite, "the objective or its shape gradient is not finite"};
  return evaluation;
}

template <int dim>
Expected<Evaluation<dim>> evaluate(const RollingProblem<dim>& problem, const Criteria<dim>& criteria,
                                   const LevelSet<dim>& psi, const Matrix* held_mean) {
  const bool compares_images_alike = !held_mean || is_mirror_symmetric(problem.tread(), *held_mean);
  const auto solution =
      problem.solve(psi, compares_images_alike ? problem.distinct_positions(psi) : problem.positions());
  if (!solution) return solution.failure();
  return differentiate(problem, criteria, *solution, held_mean);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                 \
  template Expected<Evaluation<dim>> differentiate(const RollingProblem<dim>&, const Criteria<dim>&, \
                                                   const RollingSolution<dim>&, const Matrix*);      \
  template Expected<Evaluation<dim>> evaluate(const RollingProblem<dim>&, const Criteria<dim>&,      \
                                              const LevelSet<dim>&, const Matrix*);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
