#include "wheelwright/run/results/final_results.h"

#include "wheelwright/run/results/bounds_on_finer_grid.h"
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
  Solutions(const Study<dim>& study, const Interrupt& interrupt) : study_(study), interrupt_(interrupt) {}

  SolvedStates<dim> of(const StateSolver<dim>& solver, const LevelSet<dim>& shape) {
    auto states = solver.states(shape, positions_of_results(study_, solver, shape), interrupt_);
    is_interrupted_ = is_interrupted_ || is_interruption(states);
    return states;
  }
  bool is_interrupted() const { return is_interrupted_; }

 private:
  const Study<dim>& study_;
  const Interrupt& interrupt_;
  bool is_interrupted_ = false;
};

/// The solver of the results; null if it is the study's own.
template <int dim>
std::shared_ptr<const StateSolver<dim>> solver_of_results(const Study<dim>& study) {
  const Case c = study.computed();
  if (tread_levels_of_results(c) == tread_levels(c)) return nullptr;
  auto finer = make_solver(rolling_model<dim>(with_levels_of_results(c)));
  return finer ? *std::move(finer) : nullptr;
}

/// The bounds at a shape on the grid of the solver.
template <int dim>
Expected<std::vector<BoundState>, std::string> known_bounds(const Study<dim>& study,
                                                            const StateSolver<dim>& solver,
                                                            const LevelSet<dim>& shape,
                                                            const SolvedStates<dim>& states) {
  auto bounds = bounds_of(study.source, study.load_cases, solver, shape, states);
  if (!bounds) return to_string(bounds.failure());
  return *std::move(bounds);
}

/// Estimates the errors of a summary's last shape on a finer grid; `shown` are its states by the solver.
template <int dim>
void add_errors(const Study<dim>& study, const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                const SolvedStates<dim>& shown, Solutions<dim>& solutions, RunSummary<dim>& summary) {
  const auto finer = finer_shape(study.source, solver, shape);
  if (!finer) {
    set_missing_errors(finer.failure(), summary.after);
    for (SummarizedBound& bound : summary.bounds)
      bound.finer = Expected<BoundOnFinerGrid, std::string>(finer.failure());
    return;
  }
  const auto states = solutions.of(*finer->solver, finer->shape);
  if (!summary.bounds.empty())
    add_finer_values(study.functions, known_bounds(study, solver, shape, shown),
                     known_bounds(study, *finer->solver, finer->shape, states), finer->refinement,
                     summary.bounds);
  set_errors(study.source, study.load_cases, *finer, states, summary.after);
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
  Solutions<dim> solutions(study, interrupt);
  const SolvedStates<dim> own =
      solved.last ? SolvedStates<dim>(solved.last) : solutions.of(*study.solver, state.shape);
  SolvedStates<dim> shown = own;
  std::shared_ptr<const StateSolver<dim>> solver = study.solver;
  if (const auto finer = own ? solver_of_results(study) : nullptr)
    if (auto states = solutions.of(*finer, state.shape)) {
      shown = std::move(states);
      solver = finer;
    }
  auto after = described(study.source, *solver, study.load_cases, state.shape, state.measure, shown);
  const Study<dim> given = given_study(study, initial);
  const auto before = [&] {
    if (given.grid() == study.grid() && study.initial.values == state.shape.values) return after;
    if (solved.initial && solver == study.solver && begins_as_given(given, initial)) return *solved.initial;
    const double measure =
        begins_as_given(given, initial) ? initial.measure : material_measure(given.initial);
    auto of_given = given.grid() == study.grid() ? solver
                    : solver == study.solver     ? given.solver
                                                 : solver_of_results(given);
    if (!of_given) of_given = given.solver;
    return described(given.source, *of_given, given.load_cases, given.initial, measure,
                     solutions.of(*of_given, given.initial));
  }();
  const auto objective = objective_as_given(given, initial, interrupt);
  auto summary = summarized_run(study, given, initial, objective, before, state, after);
  if (shown && study.source.output.errors == ErrorEstimates::estimated)
    add_errors(study, *solver, state.shape, shown, solutions, summary);
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
