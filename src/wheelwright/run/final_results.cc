#include "wheelwright/run/final_results.h"

#include "wheelwright/cut/measure.h"
#include "wheelwright/run/summarized_run.h"

namespace wheelwright {
namespace {

/// Solves shapes until it is interrupted.
template <int dim>
class Solutions {
 public:
  Solutions(const LoadCases<dim>& cases, const Interrupt& interrupt) : cases_(cases), interrupt_(interrupt) {}

  /// Null where there is none.
  std::shared_ptr<const State<dim>> of(const StateSolver<dim>& solver, const LevelSet<dim>& shape) {
    auto states = solver.states(shape, distinct_positions(solver, cases_, shape), interrupt_);
    if (states) return *std::move(states);
    is_interrupted_ = is_interrupted_ || states.failure().reason == FailureReason::interrupted;
    return nullptr;
  }
  bool is_interrupted() const { return is_interrupted_; }

 private:
  const LoadCases<dim>& cases_;
  const Interrupt& interrupt_;
  bool is_interrupted_ = false;
};

/// The solver of the results; null where it is the study's own.
template <int dim>
std::shared_ptr<const StateSolver<dim>> finer_solver(const Study<dim>& study) {
  const Case c = study.computed();
  if (tread_levels_of_results(c) == tread_levels(c)) return nullptr;
  auto finer = make_solver(rolling_model<dim>(with_levels_of_results(c)));
  return finer ? *std::move(finer) : nullptr;
}

/// The initial shape as the solver of the results sees it; for a run that was stopped on a coarser grid, on
/// that.
template <int dim>
std::optional<DescribedWheel<dim>> initial_wheel(const Study<dim>& study, const InitialShape<dim>& initial,
                                                 const StateSolver<dim>& solver, Solutions<dim>& solutions) {
  const bool is_coarser = study.level > 0;
  const LevelSet<dim>& shape = is_coarser ? study.initial : initial.shape;
  const auto state = solutions.of(solver, shape);
  if (!state) return {};
  return described(solver, study.load_cases, shape, is_coarser ? material_measure(shape) : initial.measure,
                   *state);
}

}  // namespace

template <int dim>
std::optional<DescribedWheel<dim>> described(const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                             const LevelSet<dim>& shape, double measure,
                                             const State<dim>& state) {
  auto wheel = described_wheel(solver, shape, volume_fraction(solver.model().grid, measure), state, cases);
  if (!wheel) return {};
  return *std::move(wheel);
}

template <int dim>
FinalResults<dim> final_results(const Study<dim>& study, const InitialShape<dim>& initial,
                                const OptimizationState<dim>& state, const SolvedShapes<dim>& solved,
                                const Interrupt& interrupt) {
  FinalResults<dim> results;
  Solutions<dim> solutions(study.load_cases, interrupt);
  results.own = solved.last ? solved.last : solutions.of(*study.solver, state.shape);
  results.shown = results.own;
  results.solver = study.solver;
  if (const auto finer = results.own ? finer_solver(study) : nullptr)
    if (auto states = solutions.of(*finer, state.shape)) {
      results.shown = std::move(states);
      results.solver = finer;
    }
  if (results.shown) {
    const auto after =
        described(*results.solver, study.load_cases, state.shape, state.measure, *results.shown);
    const bool is_seen = solved.initial && results.solver == study.solver;
    const auto before = state.iteration == 0 ? after
                        : is_seen            ? solved.initial
                                             : initial_wheel(study, initial, *results.solver, solutions);
    if (before && after) results.summary = summarized_run(study.source, initial, *before, state, *after);
  }
  results.is_interrupted = solutions.is_interrupted();
  return results;
}

template FinalResults<2> final_results(const Study<2>&, const InitialShape<2>&, const OptimizationState<2>&,
                                       const SolvedShapes<2>&, const Interrupt&);
template FinalResults<3> final_results(const Study<3>&, const InitialShape<3>&, const OptimizationState<3>&,
                                       const SolvedShapes<3>&, const Interrupt&);
template std::optional<DescribedWheel<2>> described(const StateSolver<2>&, const LoadCases<2>&,
                                                    const LevelSet<2>&, double, const State<2>&);
template std::optional<DescribedWheel<3>> described(const StateSolver<3>&, const LoadCases<3>&,
                                                    const LevelSet<3>&, double, const State<3>&);

}  // namespace wheelwright
