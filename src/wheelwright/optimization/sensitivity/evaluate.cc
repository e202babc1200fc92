#include "wheelwright/optimization/sensitivity/evaluate.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"

namespace wheelwright {
namespace {

/// The arguments of the functionals in one load case.
template <int dim>
struct CaseStates {
  const State<dim>& state;
  Matrix mean_observations;
};

/// The values of all functionals at one shape, each evaluated once per load case.
template <int dim>
class FunctionalValues {
 public:
  /// `held_mean` counts in the first load case; null: the states' own.
  FunctionalValues(std::span<const ShapeFunction<dim>> functions, const StateSolver<dim>& solver,
                   const LevelSet<dim>& psi, std::span<const CaseStates<dim>> cases,
                   const Matrix* held_mean) {
    for (const ShapeFunction<dim>& function : functions)
      for (const auto& [weight, functional, load_case, _] : function.terms) {
        if (find(*functional, load_case) != values_.end()) continue;
        const auto& [state, own_mean] = cases[load_case];
        const Matrix& mean = held_mean && load_case == 0 ? *held_mean : own_mean;
        values_.push_back({functional.get(), load_case, functional->evaluate(solver, psi, state, mean)});
      }
  }

  const FunctionalValue<dim>& of(const Functional<dim>& functional, int load_case) const {
    return find(functional, load_case)->value;
  }

  std::vector<TermValue> terms(const LoadCases<dim>& cases, const LoadPositions& positions) const {
    std::vector<TermValue> terms;
    for (const auto& [functional, load_case, of_functional] : values_) {
      const auto by_position = of_all(positions, of_functional.by_position);
      double value = of_functional.of_shape + of_functional.over_positions.value_or(0);
      for (int i = 0; i < positions.size() && !of_functional.by_position.empty(); ++i)
        value += positions.multiplicities[i] * of_functional.by_position[i];
      terms.push_back({name_in_case(functional->name(), cases, load_case), value, by_position});
    }
    return terms;
  }

 private:
  struct Evaluated {
    const Functional<dim>* functional;
    int load_case;
    FunctionalValue<dim> value;
  };

  auto find(const Functional<dim>& functional, int load_case) const {
    return std::ranges::find_if(values_, [&](const Evaluated& evaluated) {
      return evaluated.functional == &functional && evaluated.load_case == load_case;
    });
  }

  std::vector<Evaluated> values_;
};

/// A function's weighted sum of functionals.
template <int dim>
struct WeightedValues {
  FunctionValue value;
  std::vector<FunctionalDerivative<dim>> derivatives;  ///< one per load case
};

/// Whether the deviations from the positions' own mean, and thus a term's loads, sum to zero: then the mean's
/// derivative vanishes.
template <int dim>
bool deviations_sum_to_zero(const ShapeFunction<dim>& function, const FunctionalValue<dim>& term,
                            const LoadPositions& positions) {
  return function.position_weights.empty() && !term.over_positions && positions.stand_on_columns();
}

template <int dim>
WeightedValues<dim> weighted(const ShapeFunction<dim>& function, const FunctionalValues<dim>& functionals,
                             const StateSolver<dim>& solver, std::span<const CaseStates<dim>> cases,
                             bool mean_is_held) {
  const State<dim>& state = cases.front().state;
  const LoadPositions& positions = state.positions();
  WeightedValues<dim> result{.value = {function.name,
                                       0,
                                       {},
                                       std::vector<double>(state.boundary().size(), 0.0),
                                       function.bounds,
                                       std::vector<double>(state.edges().size(), 0.0),
                                       kind(function.quantity),
                                       std::vector<double>(state.model().design_lines.size(), 0.0)},
                             .derivatives = std::vector<FunctionalDerivative<dim>>(cases.size())};
  std::vector<double> by_position(positions.size(), 0.0);
  bool has_shares = false;
  for (const auto& [weight, functional, load_case, _] : function.terms) {
    const FunctionalValue<dim>& term = functionals.of(*functional, load_case);
    FunctionalDerivative<dim>& sum = result.derivatives[load_case];
    result.value.value += weight * term.of_shape;
    for (size_t q = 0; q < term.gradient_of_shape.size(); ++q)
      result.value.gradient[q] += weight * term.gradient_of_shape[q];
    for (size_t q = 0; q < term.edge_gradient_of_shape.size(); ++q)
      result.value.edge_gradient[q] += weight * term.edge_gradient_of_shape[q];
    for (size_t k = 0; k < term.by_radius_of_shape.size(); ++k)
      result.value.by_radius[k] += weight * term.by_radius_of_shape[k];
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
    if (term.compares_with_mean && !(mean_is_held && load_case == 0) &&
        !deviations_sum_to_zero(function, term, positions)) {
      FunctionalDerivative<dim> derivative;
      add(term.derivative, factors, derivative);
      add_derivative_of_mean(solver.tread_surface(), positions, derivative.tread_loads);
      add(derivative, std::vector<double>(positions.size(), 1.0), sum);
    } else {
      add(term.derivative, factors, sum);
    }
  }
  if (!has_shares) return result;
  for (int i = 0; i < positions.size(); ++i)
    result.value.value += positions.multiplicities[i] * by_position[i];
  result.value.by_position = of_all(positions, by_position);
  return result;
}

template <int dim>
std::vector<MeasureValue> measures(const LoadCases<dim>& cases, std::span<const CaseStates<dim>> states) {
  std::vector<MeasureValue> values;
  for (int k = 0; k < static_cast<int>(states.size()); ++k) {
    const RollingMeasures m = rolling_measures(contact_summaries(states[k].state));
    for (const auto& [quantity, member] : rolling_quantities)
      values.push_back({name_in_case(std::string(quantity), cases, k), m.*member});
  }
  return values;
}

template <int dim>
bool is_finite(const Evaluation<dim>& evaluation) {
  return std::ranges::all_of(evaluation.functions, [](const FunctionValue& function) {
    return std::isfinite(function.value) &&
           std::ranges::all_of(function.gradient, [](double g) { return std::isfinite(g); }) &&
           std::ranges::all_of(function.edge_gradient, [](double g) { return std::isfinite(g); }) &&
           std::ranges::all_of(function.by_radius, [](double g) { return std::isfinite(g); });
  });
}

template <int dim>
std::vector<CaseStates<dim>> case_states(const StateSolver<dim>& solver,
                                         std::span<const State<dim>* const> states) {
  std::vector<CaseStates<dim>> of_cases;
  for (const State<dim>* state : states)
    of_cases.push_back({*state, mean_observations(solver.tread_surface(), *state)});
  return of_cases;
}

/// The functions' derivatives with respect to the states of every load case, as far as they depend on them.
template <int dim>
struct ByStates {
  std::vector<FunctionValue> values;
  std::vector<std::vector<FunctionalDerivative<dim>>> derivatives;  ///< [load case]
  std::vector<std::vector<size_t>> functions;  ///< the functions that they belong to, [load case]
};

template <int dim>
ByStates<dim> by_states(std::span<const ShapeFunction<dim>> functions,
                        const FunctionalValues<dim>& functionals, const StateSolver<dim>& solver,
                        std::span<const CaseStates<dim>> cases, bool mean_is_held) {
  ByStates<dim> result{.values = {},
                       .derivatives = std::vector<std::vector<FunctionalDerivative<dim>>>(cases.size()),
                       .functions = std::vector<std::vector<size_t>>(cases.size())};
  for (const ShapeFunction<dim>& function : functions) {
    auto [value, of_function] = weighted<dim>(function, functionals, solver, cases, mean_is_held);
    for (size_t k = 0; k < cases.size(); ++k) {
      if (of_function[k].empty()) continue;  // it does not depend on these states and needs no adjoint
      result.functions[k].push_back(result.values.size());
      result.derivatives[k].push_back(std::move(of_function[k]));
    }
    result.values.push_back(std::move(value));
  }
  return result;
}

}  // namespace

template <int dim>
std::vector<FunctionValue> function_values(const StateSolver<dim>& solver,
                                           std::span<const ShapeFunction<dim>> functions,
                                           const LevelSet<dim>& psi,
                                           std::span<const State<dim>* const> states) {
  const auto of_cases = case_states(solver, states);
  const FunctionalValues<dim> functionals(functions, solver, psi, std::span<const CaseStates<dim>>(of_cases),
                                          nullptr);
  auto values = by_states<dim>(functions, functionals, solver, of_cases, false).values;
  for (FunctionValue& value : values) value.gradient = value.edge_gradient = value.by_radius = {};
  return values;
}

template <int dim>
Expected<Evaluation<dim>> differentiate(const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                        std::span<const ShapeFunction<dim>> functions,
                                        const LevelSet<dim>& psi, std::span<const State<dim>* const> states,
                                        const Matrix* held_mean) {
  Stopwatch watch;
  const auto of_cases = case_states(solver, states);
  const State<dim>& first = *states.front();
  Evaluation<dim> evaluation{.functions = {},
                             .terms = {},
                             .boundary = first.boundary(),
                             .newton_iterations = {},
                             .mean_observations = of_cases.front().mean_observations,
                             .phases = {},
                             .measures = measures<dim>(cases, of_cases),
                             .edges = first.edges(),
                             .starts = first.start_displacements()};
  for (const State<dim>* state : states) {
    evaluation.phases.insert(evaluation.phases.end(), state->phases().begin(), state->phases().end());
    for (const auto& contact : state->contacts())
      evaluation.newton_iterations.push_back(contact.newton_iterations);
  }
  const FunctionalValues<dim> functionals(functions, solver, psi, std::span<const CaseStates<dim>>(of_cases),
                                          held_mean);
  evaluation.terms = functionals.terms(cases, first.positions());
  auto of_states = by_states<dim>(functions, functionals, solver, of_cases, held_mean != nullptr);
  evaluation.functions = std::move(of_states.values);
  evaluation.phases.push_back({phase::functionals, watch.lap()});

  for (size_t k = 0; k < states.size(); ++k) {
    const auto gradients = states[k]->shape_gradients(of_states.derivatives[k]);
    if (!gradients) return gradients.failure();
    for (size_t f = 0; f < of_states.functions[k].size(); ++f) {
      FunctionValue& function = evaluation.functions[of_states.functions[k][f]];
      for (size_t q = 0; q < evaluation.boundary.size(); ++q)
        function.gradient[q] += gradients->densities[f][q];
      for (size_t q = 0; q < evaluation.edges.size(); ++q)
        function.edge_gradient[q] += gradients->edge_densities[f][q];
      for (size_t line = 0; line < function.by_radius.size(); ++line)
        function.by_radius[line] += gradients->by_radius[f][line];
    }
    evaluation.phases.insert(evaluation.phases.end(), gradients->phases.begin(), gradients->phases.end());
  }
  if (!is_finite(evaluation))
    return Failure{FailureReason::not_finite, "the objective or its shape gradient is not finite"};
  return evaluation;
}

template <int dim>
Expected<Evaluation<dim>> differentiate(const StateSolver<dim>& solver,
                                        std::span<const ShapeFunction<dim>> functions,
                                        const LevelSet<dim>& psi, const State<dim>& state,
                                        const Matrix* held_mean) {
  const State<dim>* const only = &state;
  return differentiate<dim>(solver, {}, functions, psi, std::span(&only, 1), held_mean);
}

template <int dim>
Expected<Evaluated<dim>> evaluate(const StateSolver<dim>& solver,
                                  std::span<const ShapeFunction<dim>> functions, const CutShape<dim>& shape,
                                  const Matrix* held_mean, const Interrupt& interrupt,
                                  const LoadCases<dim>& cases, const StartDisplacements& starts) {
  const bool compares_images_alike = are_mirror_symmetric(functions, MirrorPlane::azimuth) &&
                                     (!held_mean || is_mirror_symmetric(solver.tread_surface(), *held_mean));
  LoadPositions positions =
      compares_images_alike ? distinct_positions(solver, cases, shape.psi) : solver.all_positions();
  positions.on_whole_width = !are_mirror_symmetric(functions, MirrorPlane::width);
  auto states = states_of_cases(solver, cases, shape, std::move(positions), interrupt, starts);
  if (!states) return states.failure();
  std::vector<const State<dim>*> of_cases;
  for (const auto& state : *states) of_cases.push_back(state.get());
  if (auto failure = interrupt.before(phase::adjoint)) return *failure;
  auto evaluation = differentiate<dim>(solver, cases, functions, shape.psi, of_cases, held_mean);
  if (!evaluation) return evaluation.failure();
  auto first = std::move(states->front());
  states->erase(states->begin());
  return Evaluated<dim>{*std::move(evaluation), std::move(first), *std::move(states)};
}

template <int dim>
Expected<std::vector<std::vector<double>>> topological_derivatives(
    const StateSolver<dim>& solver, const LoadCases<dim>& cases,
    std::span<const ShapeFunction<dim>> functions, const LevelSet<dim>& psi,
    std::span<const State<dim>* const> states, std::span<const MaterialPoint<dim>> points, double radius) {
  const auto of_cases = case_states(solver, states);
  const FunctionalValues<dim> functionals(functions, solver, psi, std::span<const CaseStates<dim>>(of_cases),
                                          nullptr);
  const auto of_states = by_states<dim>(functions, functionals, solver, of_cases, false);
  const PolarGrid<dim>& grid = solver.model().grid;
  std::vector<std::vector<double>> result(functions.size(), std::vector<double>(points.size(), 0.0));
  for (size_t f = 0; f < functions.size(); ++f)
    for (const auto& [weight, functional, load_case, _] : functions[f].terms)
      for (size_t i = 0; i < points.size(); ++i)
        result[f][i] += weight * functional->of_small_hole(grid,
                                                           cartesian_place<dim>(grid, solver.model().degree,
                                                                                points[i].cell, points[i].xi),
                                                           radius);
  for (size_t k = 0; k < states.size(); ++k) {
    const auto derivatives = states[k]->topological_derivatives(of_states.derivatives[k], points);
    if (!derivatives) return derivatives.failure();
    for (size_t f = 0; f < of_states.functions[k].size(); ++f)
      for (size_t i = 0; i < points.size(); ++i) result[of_states.functions[k][f]][i] += (*derivatives)[f][i];
  }
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template Expected<std::vector<std::vector<double>>> topological_derivatives(                              \
      const StateSolver<dim>&, const LoadCases<dim>&, std::span<const ShapeFunction<dim>>,                  \
      const LevelSet<dim>&, std::span<const State<dim>* const>, std::span<const MaterialPoint<dim>>,        \
      double);                                                                                              \
  template decltype(function_values<dim>) function_values<dim>;                                             \
  template Expected<Evaluation<dim>> differentiate(const StateSolver<dim>&,                                 \
                                                   std::span<const ShapeFunction<dim>>,                     \
                                                   const LevelSet<dim>&, const State<dim>&, const Matrix*); \
  template Expected<Evaluation<dim>> differentiate(                                                         \
      const StateSolver<dim>&, const LoadCases<dim>&, std::span<const ShapeFunction<dim>>,                  \
      const LevelSet<dim>&, std::span<const State<dim>* const>, const Matrix*);                             \
  template Expected<Evaluated<dim>> evaluate(const StateSolver<dim>&, std::span<const ShapeFunction<dim>>,  \
                                             const CutShape<dim>&, const Matrix*, const Interrupt&,         \
                                             const LoadCases<dim>&, const StartDisplacements&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
