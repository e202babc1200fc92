#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/commands/command.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

// The events of a run, as passed to its observers. References and pointers are valid only during the call.

/// The run starts, or is resumed after this shape.
struct RunStarted {
  std::optional<int> resumed_after;
};

/// A shape was tried. `state` is the last accepted one, this trial's if it was accepted. If the case of the
/// run changed, the current shape is evaluated again, as an accepted trial of the same iteration.
template <int dim>
struct TrialDone {
  const Trial<dim>& trial;
  const OptimizationState<dim>& state;
  double seconds;  ///< of this trial
};

/// The contact of a shape is being solved; sent every few seconds, to show the progress of long solves.
struct ContactAdvanced {
  ContactProgress progress;
  bool for_results;  ///< of a run that has ended, also on a finer grid, and not for a new shape
};

/// The last accepted shape should be saved now, unless it is saved already.
template <int dim>
struct SaveRequested {
  const OptimizationState<dim>& state;
};

/// A command was executed or refused.
struct CommandDone {
  const Command& command;
  std::string text;  ///< what was done, or why it was refused; may be empty
  bool was_executed;
};

/// The run left out a stage of its schedule, because it failed: a coarser grid, new holes.
struct StageFailed {
  std::string stage;   ///< e.g. "nucleation"
  std::string reason;  ///< one line
};

/// The case has changed (RunView::study); the current shape is evaluated again next.
struct CaseChanged {
  std::string text;  ///< what changed
};

/// A command, or nucleation, replaced the current shape; the new one is evaluated next.
struct ShapeReplaced {
  std::string text;  ///< by what
};

/// A command drew a new shape, which is evaluated next: followed by ShapeReplaced, or by a refusal of the
/// command.
template <int dim>
struct ShapeProposed {
  const LevelSet<dim>& shape;
};

/// The run waits for commands, saved.
struct RunWaits {
  std::optional<StopReason> reason;  ///< why there is nothing to do; empty: paused by a command
};

/// A waiting run continues.
struct RunProceeds {};

/// The descent continues on another grid (RunView::study); the current shape, transferred to it, is evaluated
/// next.
struct GridChanged {
  std::string text;  ///< the grid
};

/// The run ended, by itself or by request.
template <int dim>
struct RunEnded {
  StopReason reason;
  const OptimizationState<dim>* state;        ///< the last accepted shape; null after a failed start
  const State<dim>* solution;                 ///< its solution, for the results; null if there is none
  const StateSolver<dim>* solver;             ///< of that solution; its tread may be finer than the study's
  const RunSummary<dim>* summary;             ///< null after a failed start
  std::span<const Trial<dim>> failed_trials;  ///< after the last accepted shape
};

/// One load position of the last shape of a run: if the shape has a solution, all of them are sent before
/// RunEnded, in order.
template <int dim>
struct PositionShown {
  const RunEnded<dim>& ended;
  int position;
  const PositionFields<dim>& fields;
};

template <int dim>
using Event = std::variant<RunStarted, TrialDone<dim>, ContactAdvanced, SaveRequested<dim>, CommandDone,
                           StageFailed, CaseChanged, ShapeProposed<dim>, ShapeReplaced, GridChanged, RunWaits,
                           RunProceeds, PositionShown<dim>, RunEnded<dim>>;

template <int dim>
class Observer;

template <int dim>
using Observers = std::vector<std::unique_ptr<Observer<dim>>>;

/// The run at the time of an event.
template <int dim>
struct RunView {
  const std::filesystem::path& folder;
  const Study<dim>& study;
  const Evolver<dim>& evolver;       ///< the loop's
  const InitialShape<dim>* initial;  ///< null before the first shape
  const Nucleation<dim>& nucleation;
  double elapsed_seconds;           ///< of computation so far, including before a resumption
  bool can_undo;                    ///< whether there is something for the command Undo
  const Observers<dim>& observers;  ///< all of them; they contribute to checkpoints
};

/// Observes a run. The run does not know what its observers do; none of them solves or factors anything. To
/// add one, write a class like this in its own file, and add a line to make_observers()
/// (run/observers/observers.cc), or call Run::add() from outside.
template <int dim>
class Observer {
 public:
  virtual ~Observer() = default;

  /// Throws OutputError if it writes files.
  virtual void operator()(const Event<dim>& event, const RunView<dim>& run) = 0;

  /// Adds to a checkpoint what this observer needs to resume after the last accepted shape; files that it
  /// refers to are on disk when it returns. Throws OutputError.
  virtual void add_to(Checkpoint<dim>&) {}
};

}  // namespace wheelwright
