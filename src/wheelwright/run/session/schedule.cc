#include "wheelwright/run/session/schedule.h"

#include <fmt/format.h>

#include "wheelwright/run/study/nucleated_shape.h"

namespace wheelwright {
namespace {

bool is_interruption(const Failure& failure) { return failure.reason == FailureReason::interrupted; }

}  // namespace

template <int dim>
Next Schedule<dim>::begin() {
  if (!begins_on_coarser_grid()) return Next::search;
  const Case source = session_.study().source;
  for (int level = source.optimizer.coarse_levels; level > 0; --level) {
    auto stage = session_.on_grid(level);
    if (stage) {
      enter_grid(*std::move(stage));
      return Next::search;
    }
    if (is_interruption(stage.failure())) return Next::obey;
    journal_.notify(StageFailed{grid_text(on_coarser_grid(source, level)), to_string(stage.failure())});
  }
  return Next::search;
}

/// Also true for a run that was stopped before the descent started.
template <int dim>
bool Schedule<dim>::begins_on_coarser_grid() const {
  const Study<dim>& study = session_.study();
  const Optimizer& o = study.source.optimizer;
  return study.level == 0 && session_.state().iteration == 0 && o.coarse_levels > 0 && o.iterations > 0;
}

template <int dim>
Expected<Next> Schedule<dim>::after(StopReason reason) {
  const Next holes = change_holes(reason);
  if (holes != Next::end || session_.study().level == 0) return holes;
  return refine_grid(reason);
}

/// Next::end: holes are no reason to continue.
template <int dim>
Next Schedule<dim>::change_holes(StopReason reason) {
  const Study<dim>& study = session_.study();
  Nucleation<dim> nucleation = session_.nucleation();
  if (study.source.optimizer.nucleation == NucleationTime::never || nucleation.is_over) return Next::end;
  if (nucleation.before && !has_paid<dim>(study.optimizer, *nucleation.before, session_.state().evaluation))
    return undo_holes(reason);
  nucleation.before.reset();
  session_.set_nucleation(std::move(nucleation));
  const bool is_done = reason == StopReason::converged || reason == StopReason::no_descent;
  return is_done ? make_holes() : Next::end;
}

template <int dim>
Next Schedule<dim>::make_holes() {
  const auto bench = session_.bench();
  const OptimizationState<dim>& state = session_.state();
  const Evolver<dim>& evolver = bench->optimizer.evolver();
  const auto made = nucleated_shape<dim>(bench->study, bench->evaluate, evolver, state);
  if (!made) return without_more_holes(made.failure());
  if (!*made) {
    session_.set_nucleation({.before = {}, .is_over = true});
    return Next::end;
  }
  auto stage = session_.at((*made)->shape, bench->optimizer);
  if (!stage) return without_more_holes(stage.failure());
  stage->trial.events = evolver.changes(state.shape, stage->state.shape);
  stage->nucleation = {.before = before_nucleation(bench->study.optimizer, state), .is_over = false};
  enter<dim>(session_, journal_, *std::move(stage), ShapeReplaced{(*made)->text});
  return Next::search;
}

/// Returns to the shape before the newest holes, with which the search ends. Holes that ran out of shapes may
/// be created again if the run is extended.
template <int dim>
Next Schedule<dim>::undo_holes(StopReason reason) {
  const auto bench = session_.bench();
  const auto& before = *session_.nucleation().before;
  auto stage = session_.at(before.shape, bench->optimizer);
  if (!stage) return without_more_holes(stage.failure());
  stage->trial.events = bench->optimizer.evolver().changes(session_.state().shape, stage->state.shape);
  stage->nucleation.is_over = reason != StopReason::iterations;
  const std::string text =
      fmt::format("nucleation undone: it ended at {:.6g}, not below {:.6g}",
                  bench->optimizer.objective_of(session_.state().evaluation), before.objective);
  enter<dim>(session_, journal_, *std::move(stage), ShapeReplaced{text});
  return Next::end;
}

/// After a failure to create or undo holes.
template <int dim>
Next Schedule<dim>::without_more_holes(const Failure& failure) {
  if (is_interruption(failure)) return Next::obey;
  Nucleation<dim> nucleation = session_.nucleation();
  nucleation.is_over = true;
  session_.set_nucleation(std::move(nucleation));
  journal_.notify(StageFailed{"nucleation", to_string(failure)});
  return Next::end;
}

/// If no shapes are left for finer grids, the results are still those of the case's own grid.
template <int dim>
Expected<Next> Schedule<dim>::refine_grid(StopReason reason) {
  auto stage = session_.on_grid(reason == StopReason::iterations ? 0 : session_.study().level - 1);
  if (!stage && is_interruption(stage.failure())) return Next::obey;
  if (!stage) return stage.failure();
  enter_grid(*std::move(stage));
  return Next::search;
}

template <int dim>
void Schedule<dim>::enter_grid(Stage<dim> stage) {
  const std::string grid = grid_text(stage.bench->study.computed());
  enter<dim>(session_, journal_, std::move(stage), GridChanged{grid});
}

template class Schedule<2>;
template class Schedule<3>;

}  // namespace wheelwright
