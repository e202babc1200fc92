#include "wheelwright/run/results/final_results.h"

#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/results/given_wheel.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/run/results/summarized_run.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

template <class T>
bool is_interruption(const Expected<T>& result) {
  return !result && result.failure().reason == FailureReason::interrupted;
}

/// Solves shapes until it is interrupted.
template <int dim>
class Solutions {
 public:
  Solutions(const LoadCases<dim>& cases, const Interrupt& interrupt) : cases_(cases), interrupt_(interrupt) {}

  SolvedStates<dim> of(const StateSolver<dim>& solver, const LevelSet<dim>& shape) {
    auto states = solver.states(shape, distinct_positions(solver, cases_, shape), interrupt_);
    is_interrupted_ = is_interrupted_ || is_interruption(states);
    return states;
  }
  bool is_interrupted() const { return is_interrupted_; }

 private:
  const LoadCases<dim>& cases_;
  const Interrupt& interrupt_;
  bool is_interrupted_ = false;
};

/// The solver of the results; null if it is the study's own.
template <int dim>
std::shared_ptr<const StateSolver<dim>> finer_solver(const Study<dim>& study) {
  const Case c = study.computed();
  if (tread_levels_of_results(c) == tread_levels(c)) return nullptr;
  auto finer = make_solver(rolling_model<dim>(with_levels_of_results(c)));
  return finer ? *std::move(finer) : nullptr;
}

}  // namespace

template <int dim>
DescribedWheel<dim> described(const Case& c, const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                              const LevelSet<dim>& shape, double measure, const SolvedStates<dim>& states) {
  return described_wheel(solver, shape, volume_fraction(solver.model().grid, measure), states, cases,
                         own_numbers(c, solver, shape));
}

template <int dim>
FinalResults<dim> final_results(const Study<dim>& study, const InitialShape<dim>& initial,
                                const OptimizationState<dim>& state, const SolvedShapes<dim>& solved,
                                const Interrupt& interrupt) {
  Solutions<dim> solutions(study.load_cases, interrupt);
  const SolvedStates<dim> own =
      solved.last ? SolvedStates<dim>(solved.last) : solutions.of(*study.solver, state.shape);
  SolvedStates<dim> shown = own;
  std::shared_ptr<const StateSolver<dim>> solver = study.solver;
  if (const auto finer = own ? finer_solver(study) : nullptr)
    if (auto states = solutions.of(*finer, state.shape)) {
      shown = std::move(states);
      solver = finer;
    }
  const auto after = described(study.source, *solver, study.load_cases, state.shape, state.measure, shown);
  const auto before = [&] {
    if (study.initial.values == state.shape.values) return after;
    if (solved.initial && solver == study.solver && begins_as_given(study, initial)) return *solved.initial;
    const double measure =
        begins_as_given(study, initial) ? initial.measure : material_measure(study.initial);
    return described(study.source, *solver, study.load_cases, study.initial, measure,
                     solutions.of(*solver, study.initial));
  }();
  const auto objective = objective_as_given(study, initial, interrupt);
  auto summary = summarized_run(study, initial, objective, before, state, after);
  if (shown && study.source.output.errors == ErrorEstimates::estimated)
    add_errors<dim>(
        study.source, study.load_cases, *solver, state.shape,
        [&](const StateSolver<dim>& of, const LevelSet<dim>& shape) { return solutions.of(of, shape); },
        summary.after);
  return {.own = own,
          .solver = solver,
          .shown = shown ? *shown : nullptr,
          .summary = std::move(summary),
          .is_interrupted = solutions.is_interrupted() || is_interruption(objective)};
}

template decltype(final_results<2>) final_results<2>;
template decltype(final_results<3>) final_results<3>;
template decltype(described<2>) described<2>;
template decltype(described<3>) described<3>;

}  // namespace wheelwright
