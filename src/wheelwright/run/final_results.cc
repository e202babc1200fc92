#include "wheelwright/run/final_results.h"

#include "wheelwright/cut/measure.h"
#include "wheelwright/run/summarized_run.h"

namespace wheelwright {
namespace {

template <int dim>
std::shared_ptr<const State<dim>> solution(const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                                           const Interrupt& interrupt) {
  auto states = solver.states(shape, solver.distinct_positions(shape), interrupt);
  return states ? *std::move(states) : nullptr;
}

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
                                                 const StateSolver<dim>& solver, const Interrupt& interrupt) {
  const bool is_coarser = study.level > 0;
  const LevelSet<dim>& shape = is_coarser ? study.initial : initial.shape;
  const auto state = solution(solver, shape, interrupt);
  if (!state) return {};
  return described(solver, shape, is_coarser ? material_measure(shape) : initial.measure, *state);
}

}  // namespace

template <int dim>
std::optional<DescribedWheel<dim>> described(const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                                             double measure, const State<dim>& state) {
  auto wheel = described_wheel(solver, shape, volume_fraction(solver.model().grid, measure), state);
  if (!wheel) return {};
  return *std::move(wheel);
}

template <int dim>
FinalResults<dim> final_results(const Study<dim>& study, const InitialShape<dim>& initial,
                                const OptimizationState<dim>& state, const SolvedShapes<dim>& solved,
                                const Interrupt& interrupt) {
  FinalResults<dim> results;
  results.own = solved.last ? solved.last : solution(*study.solver, state.shape, interrupt);
  results.shown = results.own;
  results.solver = study.solver;
  if (!results.own) return results;
  if (auto finer = finer_solver(study))
    if (auto states = solution(*finer, state.shape, interrupt)) {
      results.shown = std::move(states);
      results.solver = std::move(finer);
    }
  const auto after = described(*results.solver, state.shape, state.measure, *results.shown);
  if (!after) return results;
  const bool is_seen = solved.initial && results.solver == study.solver;
  const auto before = state.iteration == 0 ? after
                      : is_seen            ? solved.initial
                                           : initial_wheel(study, initial, *results.solver, interrupt);
  if (before) results.summary = summarized_run(study.source, initial, *before, state, *after);
  return results;
}

template FinalResults<2> final_results(const Study<2>&, const InitialShape<2>&, const OptimizationState<2>&,
                                       const SolvedShapes<2>&, const Interrupt&);
template FinalResults<3> final_results(const Study<3>&, const InitialShape<3>&, const OptimizationState<3>&,
                                       const SolvedShapes<3>&, const Interrupt&);
template std::optional<DescribedWheel<2>> described(const StateSolver<2>&, const LevelSet<2>&, double,
                                                    const State<2>&);
template std::optional<DescribedWheel<3>> described(const StateSolver<3>&, const LevelSet<3>&, double,
                                                    const State<3>&);

}  // namespace wheelwright
