#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wheelwright/report/run_summary.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/command.h"
#include "wheelwright/run/study.h"

namespace wheelwright {

// What happens in a run, as its observers are told. References and pointers are valid during the call only.

/// The run begins, or is resumed after this shape.
struct RunStarted {
  std::optional<int> resumed_after;
};

/// A shape was tried. `state` is the last accepted one, this trial's if it was accepted. When the case of the
/// run changed, the current shape is evaluated anew, as an accepted trial of the same iteration.
template <int dim>
struct TrialDone {
  const Trial<dim>& trial;
  const OptimizationState<dim>& state;
  double seconds;  ///< of this trial
};

/// The contact of a shape is being solved; told every few seconds, so that long solves show that they go on.
struct ContactAdvanced {
  ContactProgress progress;
};

/// The last accepted shape should be saved now, unless it is saved already.
template <int dim>
struct SaveRequested {
  const OptimizationState<dim>& state;
};

/// A command was obeyed, or refused.
struct CommandDone {
  const Command* command;  ///< null where the run gave it to itself
  std::string text;        ///< what was done, or why it was refused; may be empty
  bool was_obeyed;
};

/// The case is another one from now on (RunView::study); the current shape is evaluated anew next.
struct CaseChanged {
  std::string text;  ///< what changed
};

/// A command, or the making of holes, replaced the current shape; the new one is evaluated next.
struct ShapeReplaced {
  std::string text;  ///< by what
};

/// A command drew another shape, which is evaluated next: ShapeReplaced follows, or a refusal of the command.
template <int dim>
struct ShapeProposed {
  const LevelSet<dim>& shape;
};

/// The run waits for commands, saved.
struct RunWaits {
  std::optional<StopReason> reason;  ///< why there is nothing to do; empty: it was told to pause
};

/// A run that waited proceeds.
struct RunProceeds {};

/// The descent proceeds on another grid (RunView::study); the current shape, moved there, is evaluated next.
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

/// One load position of the last shape of a run: all of them are told before RunEnded, in their order, where
/// the shape has a solution.
template <int dim>
struct PositionShown {
  const RunEnded<dim>& ended;
  int position;
  const PositionFields<dim>& fields;
};

template <int dim>
using Event = std::variant<RunStarted, TrialDone<dim>, ContactAdvanced, SaveRequested<dim>, CommandDone,
                           CaseChanged, ShapeProposed<dim>, ShapeReplaced, GridChanged, RunWaits, RunProceeds,
                           PositionShown<dim>, RunEnded<dim>>;

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
  double elapsed_seconds;           ///< computed so far, before a resumption too
  bool can_undo;                    ///< whether there is something for the command Undo
  const Observers<dim>& observers;  ///< all of them, for whom a checkpoint asks
};

/// Watches a run. The run knows nothing of what its observers do; none of them solves or factors anything. To
/// add one: a class like this in a file of its own, and its line in make_observers() (run/observers.cc), or
/// in a call of Run::add() from outside.
template <int dim>
class Observer {
 public:
  virtual ~Observer() = default;

  /// Throws OutputError if it writes files.
  virtual void operator()(const Event<dim>& event, const RunView<dim>& run) = 0;

  /// Adds to a checkpoint what this observer needs when the run is resumed after the last accepted shape;
  /// files that it refers to are on the disk then. Throws OutputError.
  virtual void add_to(Checkpoint<dim>&) {}
};

}  // namespace wheelwright
