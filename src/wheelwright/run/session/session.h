#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "wheelwright/optimization/nucleation/nucleation.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/commands/run_control.h"
#include "wheelwright/run/study/moved_studies.h"

namespace wheelwright {

/// What the shapes of one case are computed with, on one grid.
template <int dim>
struct Workbench {
  Study<dim> study;
  typename ShapeOptimizer<dim>::Evaluate evaluate;  ///< ended early by a command to stop
  ShapeOptimizer<dim> optimizer;                    ///< with that evaluation
  ShapeOptimizer<dim> uninterrupted;                ///< the same; its evaluations are always completed
  std::shared_ptr<MovedStudies<dim>> moved;         ///< of a case with design radii; otherwise null
};

/// A state of a session from which the search can continue: another shape, grid or case.
template <int dim>
struct Stage {
  std::shared_ptr<const Workbench<dim>> bench;
  OptimizationState<dim> state;
  InitialShape<dim> initial;
  Nucleation<dim> nucleation;
  Trial<dim> trial;  ///< the evaluation of the state's shape
};

/// A stage, or why the current one remains.
template <int dim>
using NextStage = Expected<Stage<dim>>;

/// What the command Undo returns to.
template <int dim>
struct Past {
  Case source;
  LevelSet<dim> shape;
  std::string change;  ///< readable description of the change that followed
};

/// The case of a run, its current shape, and the changes that can be undone. Functions that return a Stage
/// evaluate a shape and change nothing; enter() continues from their result.
template <int dim>
class Session {
 public:
  /// `on_stop` ends evaluations early, `completed` only reports their progress.
  Session(Study<dim> study, Interrupt on_stop, Interrupt completed);

  /// At the first shape of a run.
  void begin(OptimizationState<dim> first);
  /// As a checkpoint left it.
  void resume(const Checkpoint<dim>& checkpoint);
  void enter(Stage<dim> stage);
  /// Gives the case the radii of the state's design lines, if they moved. Returns whether they did.
  bool follow_radii();

  bool has_shape() const { return state_.has_value(); }
  const Study<dim>& study() const { return bench_->study; }
  /// Remains usable after another stage is entered.
  std::shared_ptr<const Workbench<dim>> bench() const { return bench_; }
  const OptimizationState<dim>& state() const { return *state_; }
  /// For the optimizer, which advances it.
  OptimizationState<dim>& state() { return *state_; }
  /// Null before the first shape.
  const InitialShape<dim>* initial() const { return initial_ ? &*initial_ : nullptr; }
  const Nucleation<dim>& nucleation() const { return nucleation_; }
  void set_nucleation(Nucleation<dim> nucleation) { nucleation_ = std::move(nucleation); }

  /// At another shape, on any grid of the same wheel. Its evaluation ends early if `optimizer` says so.
  NextStage<dim> at(const LevelSet<dim>& shape, const ShapeOptimizer<dim>& optimizer) const;
  /// The same; the evaluation is completed.
  NextStage<dim> at(const LevelSet<dim>& shape) const { return at(shape, bench_->uninterrupted); }
  /// At another shape under another case, whose grid must be the same.
  Expected<Stage<dim>, Refusal> under(const Case& c, const LevelSet<dim>& shape) const;
  /// At the current shape on the grid of another level (case/coarse_grid.h). The trial's events are the
  /// changes of the holes by the transfer.
  NextStage<dim> on_grid(int level) const;

  /// The present case and shape, before a change with that description.
  Past<dim> present(const std::string& change) const { return {study().source, state_->shape, change}; }
  /// Keeps the newest 100.
  void remember(Past<dim> past);
  /// Newest last.
  const std::deque<Past<dim>>& past() const { return past_; }
  void forget_newest() { past_.pop_back(); }

 private:
  std::shared_ptr<const Workbench<dim>> make_bench(Study<dim> study) const;
  std::shared_ptr<const Workbench<dim>> make_bench(Study<dim> study,
                                                   std::shared_ptr<MovedStudies<dim>> moved) const;

  Interrupt on_stop_, completed_;
  std::shared_ptr<const Workbench<dim>> bench_;
  std::optional<OptimizationState<dim>> state_;  ///< empty before the first shape
  std::optional<InitialShape<dim>> initial_;     ///< empty before the first shape
  Nucleation<dim> nucleation_;
  std::deque<Past<dim>> past_;
};

}  // namespace wheelwright
