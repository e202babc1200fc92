#include "wheelwright/run/optimize_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>

#include "wheelwright/run/checkpointer.h"
#include "wheelwright/run/failure_report.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/run/folder_lock.h"

namespace wheelwright {
namespace {

int give_up(const Failure& failure) {
  tell("wheelwright: {}: {}\n", to_string(failure.reason), failure.detail);
  return exit_no_solution;
}

int give_up(const std::filesystem::path& folder, const Case& c, const GivenUp& failure) {
  tell("wheelwright: {}", write_failure(folder, c, failure));
  return exit_no_solution;
}

void print_weights(const Criteria<2>& objective) {
  for (const auto& [weight, criterion] : objective)
    if (objective.size() > 1) tell("objective: {:.6g} * {}\n", weight, criterion->name());
}

void print_summary(const InitialShape<2>& first, const OptimizationState<2>& last, StopReason reason,
                   double seconds, const std::filesystem::path& folder) {
  const PolarGrid<2>& grid = last.shape.lattice.grid();
  fmt::print("objective  {:.6g} -> {:.6g} J/m ({:+.2f} %) after {} shapes in {:.1f} s ({})\n",
             first.objective, last.evaluation.objective,
             100 * (last.evaluation.objective / first.objective - 1), last.iteration, seconds,
             to_string(reason));
  fmt::print("volume     {:.6f} -> {:.6f} of the ring\n", volume_fraction(grid, first.measure),
             volume_fraction(grid, last.measure));
  for (const auto& [file, meaning] :
       {std::pair{"comparison.svg", "before and after"},
        {"shape.svg", "the shape in true scale, for cutting"},
        {"stress.svg", "the loaded wheel; stress_contact.svg about the contact"},
        {"displacement.svg", "the loaded wheel, how far its points come down"},
        {"mesh.svg", "the grid and the cells that the boundary cuts"},
        {"history.csv", "every trial shape"},
        {"shapes.pvd", "all shapes, for ParaView"},
        {"rolling.pvd", "all load positions, for ParaView"}})
    fmt::print("  {:<36} {}\n", (folder / file).string(), meaning);
}

/// Tells what was expected and how it turned out.
int report_findings(const std::vector<Finding>& findings) {
  const auto unmet = std::ranges::count_if(findings, [](const Finding& f) { return !f.met(); });
  if (!findings.empty())
    fmt::print("expected   {} of {} values found\n", findings.size() - unmet, findings.size());
  for (const Finding& finding : findings)
    if (!finding.met()) tell("wheelwright: {}\n", finding.text());
  return unmet > 0 ? exit_unexpected : exit_done;
}

/// What may ask a run to stop: a signal, or a file STOP in its folder.
class StopRequest {
 public:
  StopRequest(const Signals& signals, const std::filesystem::path& folder)
      : signals_(signals), file_(folder / "STOP") {}

  bool operator()() const {
    std::error_code ignored;
    return signals_.stop() || std::filesystem::exists(file_, ignored);
  }
  void remove_file() const {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  ExitCode exit_code() const {
    const auto signal = signals_.stop();
    return signal == SIGINT ? exit_interrupted : signal == SIGHUP ? exit_hung_up : exit_terminated;
  }

 private:
  const Signals& signals_;
  std::filesystem::path file_;
};

/// The mean contact stress that a run compares with, when the case wants it held: the last accepted shape's.
class HeldMean {
 public:
  explicit HeldMean(const Case& c) : is_held_(c.objective.mean == MeanStress::held) {}

  void hold(const OptimizationState<2>& state) {
    if (is_held_) mean_ = state.evaluation.mean_observations;
  }
  /// Null for the shape's own.
  const Matrix* get() const { return mean_ ? &*mean_ : nullptr; }

 private:
  bool is_held_;
  std::optional<Matrix> mean_;
};

/// Whether the checkpoint's mean contact stress is one of this problem's tread.
bool fits(const OptimizationState<2>& state, const RollingProblem<2>& problem) {
  const Matrix& mean = state.evaluation.mean_observations;
  return mean.rows() == problem.tread().n_observations() && mean.columns() == problem.tread().n_columns();
}

/// start() of a new run, or the state of one that goes on.
Expected<OptimizationState<2>> first_state(const ShapeOptimizer<2>& optimizer, const LevelSet<2>& initial,
                                           const ShapeOptimizer<2>::Observer& observer,
                                           const std::optional<Checkpoint<2>>& checkpoint) {
  if (checkpoint) return checkpoint->state;
  return optimizer.start(initial, observer);
}

}  // namespace

int optimize_case(const Case& c, const RunStart& start) {
  Signals signals;
  const auto problem = RollingProblem<2>::create(rolling_model(c));
  if (!problem) return give_up(problem.failure());
  const auto objective = criteria(c, *problem);
  if (!objective) return give_up(objective.failure());
  print_weights(*objective);
  const auto& checkpoint = start.checkpoint;
  if (checkpoint && !fits(checkpoint->state, *problem)) {
    tell("{}: the checkpoint's mean contact stress does not fit the tread\n", start.folder.string());
    return exit_checkpoint;
  }

  RunFolder folder(start.folder, c, checkpoint ? std::optional(checkpoint->state.iteration) : std::nullopt);
  RunRecorder recorder(c, *problem, *objective, folder, checkpoint);
  Checkpointer checkpointer(c, start.checkpoints, recorder, signals, checkpoint);
  HeldMean mean(c);
  if (checkpoint) mean.hold(checkpoint->state);
  const auto observer = [&](const Trial<2>& trial, const OptimizationState<2>& state) {
    mean.hold(state);
    recorder(trial, state);
    checkpointer(trial, state);
  };
  const StopRequest stop_requested(signals, start.folder);

  if (!checkpoint)
    for (const auto& event : lost_on_the_grid(c))
      recorder.note("warning: the grid is too coarse for the case's holes: " + text(event));
  const LevelSet<2> initial = initial_shape(c);
  const ShapeOptimizer<2> optimizer(
      initial.lattice, evolution_options(c), optimizer_options(c),
      [&](const LevelSet<2>& psi) { return evaluate<2>(*problem, *objective, psi, mean.get()); });
  auto state = first_state(optimizer, initial, observer, checkpoint);
  if (!state) {
    const Trial<2> first{0, 0, 0, 0, 0, initial, 0, Verdict::failed, {}, state.failure(), {}};
    return give_up(start.folder, c, {{}, {&first, 1}});
  }
  const StopReason reason = optimizer.run(*state, observer, stop_requested);
  checkpointer.save(*state);
  stop_requested.remove_file();
  recorder.end_progress();
  if (reason == StopReason::stop_requested) {
    tell("stopped after {} shapes, saved; to go on: wheelwright resume {}\n", state->iteration,
         start.folder.string());
    return stop_requested.exit_code();
  }
  folder.write_result(*problem, *recorder.initial(), *state);
  if (reason != StopReason::gave_up) checkpointer.save_finished(*state, reason);
  print_summary(*recorder.initial(), *state, reason, recorder.elapsed(), start.folder);
  if (reason == StopReason::gave_up) return give_up(start.folder, c, {*state, recorder.failed()});
  return report_findings(recorder.expectations().findings(*problem, *state));
}

int report_expectations(const Case& c, const Checkpoint<2>& end) {
  if (c.expectations.empty()) return exit_done;
  const auto problem = RollingProblem<2>::create(rolling_model(c));
  if (!problem) return give_up(problem.failure());
  return report_findings(ExpectationWatch(c.expectations, end.found).findings(*problem, end.state));
}

int in_locked_folder(const std::filesystem::path& folder, const std::function<int()>& work) {
  const auto lock = FolderLock::acquire(folder);
  if (lock) return work();
  tell("{}: another run is writing to this folder\n", folder.string());
  return exit_refused;
}

}  // namespace wheelwright
