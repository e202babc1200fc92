#include "wheelwright/app/terminal_observer.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/analysis/deformation_size.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/run/feature_warnings.h"

namespace wheelwright {
namespace {

template <int dim>
std::string reason(const Trial<dim>& trial) {
  return trial.failure ? fmt::format("{} ({})", to_string(trial.failure->reason), trial.failure->detail)
                       : to_string(trial.verdict);
}

template <int dim>
void print_weights(const Study<dim>& study) {
  const WeightedSum<dim>& terms = study.objective().terms;
  for (const auto& [weight, functional, load_case] : terms)
    if (terms.size() > 1)
      tell("objective: {:.6g} * {}\n", weight, name_in_case(functional->name(), study.load_cases, load_case));
}

}  // namespace

template <int dim>
void TerminalObserver<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* started = std::get_if<RunStarted>(&event)) begin(*started, run);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event)) show(*done, run);
  if (const auto* advanced = std::get_if<ContactAdvanced>(&event)) progress_.note(text(advanced->progress));
  if (const auto* changed = std::get_if<GridChanged>(&event))
    progress_.note("going on with the " + changed->text);
  if (const auto* command = std::get_if<CommandDone>(&event); command && !command->text.empty())
    progress_.note((command->was_obeyed ? "" : "refused: ") + command->text);
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event)) {
    if (ended->summary) {
      const DescribedWheel<dim>& wheel = ended->summary->after.wheel;
      if (wheel.loaded) warn(wheel.loaded->summary.deformation);
      if (wheel.clearances)
        for (const std::string& warning : feature_warnings(run.study.source, *wheel.clearances))
          progress_.note("warning: " + warning);
    }
    progress_.end();
  }
}

template <int dim>
void TerminalObserver<dim>::begin(const RunStarted& started, const RunView<dim>& run) {
  print_weights(run.study);
  if (started.resumed_after) return;
  if (const auto change = volume_change_of_saved_shape<dim>(run.study.source)) progress_.note(text(*change));
  for (const auto& event : lost_on_the_grid<dim>(run.study.source))
    progress_.note("warning: the grid is too coarse for the case's holes: " + text(event));
}

template <int dim>
void TerminalObserver<dim>::warn(const DeformationSize& size) {
  const auto warning = deformation_warning(size);
  if (!warning.empty()) progress_.note("warning: " + warning);
}

/// Tells of bounds that the first shape violates, and when all are kept for the first time.
template <int dim>
void TerminalObserver<dim>::note_bounds(const OptimizationState<dim>& state) {
  const auto bounds = bound_states(state.evaluation, {});
  const bool are_kept = std::ranges::all_of(bounds, &BoundState::is_kept);
  if (state.iteration == 0)
    for (const BoundState& bound : bounds)
      if (!bound.is_kept()) progress_.note("the initial shape does not keep a bound: " + bound.text());
  if (are_kept && !were_kept_) progress_.note(fmt::format("shape {}: all bounds are kept", state.iteration));
  were_kept_ = are_kept;
}

template <int dim>
void TerminalObserver<dim>::show(const TrialDone<dim>& done, const RunView<dim>& run) {
  const auto& [trial, state, seconds] = done;
  if (trial.verdict != Verdict::accepted) {
    const std::string halved = trial.step > 0 ? fmt::format(", step {:.3g} cells halved", trial.step) : "";
    progress_.note(fmt::format("shape {}: {}{}", trial.iteration, reason(trial), halved));
    return;
  }
  for (const auto& event : trial.events)
    progress_.note(fmt::format("shape {}: {}", trial.iteration, text(event)));
  if (state.iteration == 0 && trial.solution)
    warn(deformation_size(*run.study.solver, trial.shape, *trial.solution));
  note_bounds(state);
  const PolarGrid<dim>& grid = run.study.grid();
  progress_.show({.shape = state.iteration,
                  .n_shapes = run.study.optimizer.iterations,
                  .objective = state.evaluation.function("objective").value,
                  .initial_objective = run.initial->objective,
                  .volume_fraction = volume_fraction(grid, state.measure),
                  .step = trial.step * grid.resolution(),
                  .elapsed_seconds = run.elapsed_seconds});
}

template class TerminalObserver<2>;
template class TerminalObserver<3>;

}  // namespace wheelwright
