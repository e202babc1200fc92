#include "wheelwright/sensitivity/evaluate.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/analysis/shape_summary.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/functionals/mean_contact_stress.h"

namespace wheelwright {
namespace {

/// Every functional of the functions at one shape, each evaluated once.
template <int dim>
class FunctionalValues {
 public:
  FunctionalValues(std::span<const ShapeFunction<dim>> functions, const StateSolver<dim>& solver,
                   const LevelSet<dim>& psi, const State<dim>& state, const Matrix& mean) {
    for (const ShapeFunction<dim>& function : functions)
      for (const auto& [weight, functional] : function.terms)
        if (std::ranges::find(functionals_, functional.get()) == functionals_.end()) {
          functionals_.push_back(functional.get());
          values_.push_back(functional->evaluate(solver, psi, state, mean));
        }
  }

  const FunctionalValue<dim>& of(const Functional<dim>& functional) const {
    return values_[std::ranges::find(functionals_, &functional) - functionals_.begin()];
  }

  std::vector<TermValue> terms(const LoadPositions& positions) const {
    std::vector<TermValue> terms;
    for (size_t k = 0; k < values_.size(); ++k) {
      const auto by_position = of_all(positions, values_[k].by_position);
      double value = values_[k].of_shape + values_[k].over_positions.value_or(0);
      for (int i = 0; i < positions.size() && !values_[k].by_position.empty(); ++i)
        value += positions.multiplicities[i] * values_[k].by_position[i];
      terms.push_back({functionals_[k]->name(), value, by_position});
    }
    return terms;
  }

 private:
  std::vector<const Functional<dim>*> functionals_;
  std::vector<FunctionalValue<dim>> values_;
};

/// A function's weighted sum of functionals.
template <int dim>
struct WeightedValues {
  FunctionValue value;
  FunctionalDerivative<dim> derivative;
};

/// Whether the deviations from the positions' own mean, and with them a term's loads, sum to zero: then the
/// mean's derivative vanishes.
template <int dim>
bool deviations_sum_to_zero(const ShapeFunction<dim>& function, const FunctionalValue<dim>& term,
                            const LoadPositions& positions) {
  return function.position_weights.empty() && !term.over_positions && positions.stand_on_columns();
}

template <int dim>
WeightedValues<dim> weighted(const ShapeFunction<dim>& function, const FunctionalValues<dim>& functionals,
                             const StateSolver<dim>& solver, const State<dim>& state, bool mean_is_held) {
  const LoadPositions& positions = state.positions();
  WeightedValues<dim> result{
      .value = {function.name, 0, {}, std::vector<double>(state.boundary().size(), 0.0), function.bounds},
      .derivative = {}};
  std::vector<double> by_position(positions.size(), 0.0);
  bool has_shares = false;
  for (const auto& [weight, functional] : function.terms) {
    const FunctionalValue<dim>& term = functionals.of(*functional);
    result.value.value += weight * term.of_shape;
    for (size_t q = 0; q < term.gradient_of_shape.size(); ++q)
      result.value.gradient[q] += weight * term.gradient_of_shape[q];
    std::vector<double> factors(positions.size(), weight);
    if (term.over_positions) {
      result.value.value += weight * *term.over_positions;
    } else {
      if (term.by_position.empty()) continue;
      has_shares = true;
      for (int i = 0; i < positions.size(); ++i) {
        if (!function.position_weights.empty()) factors[i] *= function.position_weights[i];
        by_position[i] += factors[i] * term.by_position[i];
      }
    }
    if (term.compares_with_mean && !mean_is_held && !deviations_sum_to_zero(function, term, positions)) {
      FunctionalDerivative<dim> derivative;
      add(term.derivative, factors, derivative);
      add_derivative_of_mean(solver.tread_surface(), positions, derivative.tread_loads);
      add(derivative, std::vector<double>(positions.size(), 1.0), result.derivative);
    } else {
      add(term.derivative, factors, result.derivative);
    }
  }
  if (!has_shares) return result;
  for (int i = 0; i < positions.size(); ++i)
    result.value.value += positions.multiplicities[i] * by_position[i];
  result.value.by_position = of_all(positions, by_position);
  return result;
}

template <int dim>
std::vector<MeasureValue> measures(const State<dim>& state) {
  const RollingMeasures m = rolling_measures(contact_summaries(state));
  std::vector<MeasureValue> values;
  for (const auto& [quantity, member] : rolling_quantities)
    values.push_back({std::string(name(quantity)), m.*member});
  return values;
}

template <int dim>
bool is_finite(const Evaluation<dim>& evaluation) {
  return std::ranges::all_of(evaluation.functions, [](const FunctionValue& function) {
    return std::isfinite(function.value) &&
           std::ranges::all_of(function.gradient, [](double g) { return std::isfinite(g); });
  });
}

}  // namespace

template <int dim>
Expected<Evaluation<dim>> differentiate(const StateSolver<dim>& solver,
                                        std::span<const ShapeFunction<dim>> functions,
                                        const LevelSet<dim>& psi, const State<dim>& state,
                                        const Matrix* held_mean) {
  Stopwatch watch;
  Evaluation<dim> evaluation{.functions = {},
                             .terms = {},
                             .boundary = state.boundary(),
                             .newton_iterations = {},
                             .mean_observations = mean_observations(solver.tread_surface(), state),
                             .phases = state.phases(),
                             .measures = measures(state)};
  for (const auto& contact : state.contacts())
    evaluation.newton_iterations.push_back(contact.newton_iterations);
  const FunctionalValues<dim> functionals(functions, solver, psi, state,
                                          held_mean ? *held_mean : evaluation.mean_observations);
  evaluation.terms = functionals.terms(state.positions());
  std::vector<FunctionalDerivative<dim>> derivatives;
  std::vector<size_t> of_states;
  for (const ShapeFunction<dim>& function : functions) {
    auto [value, derivative] = weighted(function, functionals, solver, state, held_mean != nullptr);
    if (!derivative.empty()) {  // the others depend on the shape alone and need no adjoint
      of_states.push_back(evaluation.functions.size());
      derivatives.push_back(std::move(derivative));
    }
    evaluation.functions.push_back(std::move(value));
  }
  evaluation.phases.push_back({phase::functionals, watch.lap()});

  const auto gradients = state.shape_gradients(derivatives);
  if (!gradients) return gradients.failure();
  for (size_t k = 0; k < of_states.size(); ++k)
    for (size_t q = 0; q < evaluation.boundary.size(); ++q)
      evaluation.functions[of_states[k]].gradient[q] += gradients->densities[k][q];
  evaluation.phases.insert(evaluation.phases.end(), gradients->phases.begin(), gradients->phases.end());
  if (!is_finite(evaluation))
    return Failure{FailureReason::not_finite, "the objective or its shape gradient is not finite"};
  return evaluation;
}

template <int dim>
Expected<Evaluated<dim>> evaluate(const StateSolver<dim>& solver,
                                  std::span<const ShapeFunction<dim>> functions, const CutShape<dim>& shape,
                                  const Matrix* held_mean, const Interrupt& interrupt) {
  const bool compares_images_alike = weights_are_mirror_symmetric(functions) &&
                                     (!held_mean || is_mirror_symmetric(solver.tread_surface(), *held_mean));
  auto state = solver.states(
      shape, compares_images_alike ? solver.distinct_positions(shape.psi) : solver.all_positions(),
      interrupt);
  if (!state) return state.failure();
  auto evaluation = differentiate(solver, functions, shape.psi, **state, held_mean);
  if (!evaluation) return evaluation.failure();
  return Evaluated<dim>{*std::move(evaluation), *std::move(state)};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template Expected<Evaluation<dim>> differentiate(const StateSolver<dim>&,                                 \
                                                   std::span<const ShapeFunction<dim>>,                     \
                                                   const LevelSet<dim>&, const State<dim>&, const Matrix*); \
  template Expected<Evaluated<dim>> evaluate(const StateSolver<dim>&, std::span<const ShapeFunction<dim>>,  \
                                             const CutShape<dim>&, const Matrix*, const Interrupt&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
