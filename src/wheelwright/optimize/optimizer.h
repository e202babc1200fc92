#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/evolver.h"
#include "wheelwright/optimize/optimization_state.h"
#include "wheelwright/optimize/proposals.h"
#include "wheelwright/sensitivity/evaluate.h"

namespace wheelwright {

enum class StopReason {
  iterations,      ///< the number asked for is done
  converged,       ///< the objective hardly decreases any more
  no_descent,      ///< no shape, with the step halved max_halvings times, is better and has its widths
  gave_up,         ///< no step, halved max_halvings times, gave a shape that could be evaluated, or not
                   ///< even the step 0 did
  failed_start,    ///< the initial shape could not be evaluated
  stop_requested,  ///< by the caller
};

constexpr const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::iterations:
      return "iterations";
    case StopReason::converged:
      return "converged";
    case StopReason::no_descent:
      return "no_descent";
    case StopReason::gave_up:
      return "gave_up";
    case StopReason::failed_start:
      return "failed_start";
    case StopReason::stop_requested:
      return "stop_requested";
  }
  return "unknown";
}

/// Why a run with these options goes no further than this state, if its number of shapes or its objectives
/// tell.
template <int dim>
std::optional<StopReason> reason_to_stop(const OptimizerOptions& options,
                                         const OptimizationState<dim>& state);

/// Gradient descent on shapes: velocity, transport, redistancing and smoothing when due, measure, removal of
/// islands, evaluation.
/// A measure that is not the target's moves towards it in every shape by measure_rate at most, in proportion
/// to the step. Objectives at different measures are not compared: until the target is reached, every shape
/// that can be evaluated, and whose objective does not jump, is accepted.
/// The step is halved when a trial is rejected, and for the next shape when the objective rose within bounds;
/// it grows back by half after a fall. Redistancing and smoothing wait for the next shape when a trial with
/// them is rejected.
template <int dim>
class ShapeOptimizer {
 public:
  /// `previous` is the evaluation of the last accepted shape; null for the first. A failure `interrupted` is
  /// no failed trial: the trial is forgotten and the loop stops as if asked to.
  using Evaluate =
      std::function<Expected<Evaluated<dim>>(const CutShape<dim>&, const Evaluation<dim>* previous)>;
  /// Sees every trial, accepted or rejected, and the state after it.
  using Observer = std::function<void(const Trial<dim>&, const OptimizationState<dim>&)>;

  ShapeOptimizer(const Lattice<dim>& lattice, const EvolutionOptions& evolution,
                 const OptimizerOptions& options, Evaluate evaluate);

  /// Evaluates the initial shape, cut off at the protected bands. It is shifted to the target measure, if
  /// that is given, held exactly, and no farther than measure_rate. The observer sees it as iteration 0.
  Expected<OptimizationState<dim>> start(const LevelSet<dim>& initial, const Observer& observer) const;

  /// The state's shape evaluated by this objective, in place of another one under which the shape was found.
  /// Step and history begin anew. The observer sees it as a trial of the same iteration.
  Expected<OptimizationState<dim>> restart(const OptimizationState<dim>& state,
                                           const Observer& observer) const;

  /// Proceeds to the next accepted shape, by a step or by mending the final widths; a reason when there is
  /// none, the state then stays as it is. `stop_requested` is asked before every trial. The observer sees a
  /// failure of the velocity as a trial without a shape of its own.
  std::optional<StopReason> advance(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const;

  /// Advances until there is a reason to stop.
  StopReason run(OptimizationState<dim>& state, const Observer& observer,
                 const std::function<bool()>& stop_requested) const;

  const Evolver<dim>& evolver() const { return evolver_; }

  /// The value that is minimized.
  double objective_of(const Evaluation<dim>& evaluation) const;

 private:
  using MadeCells = std::optional<CutDomain<dim>>;  ///< of the trial's shape; empty: not made yet
  enum class Mending { nothing, done, interrupted };
  Mending mend(OptimizationState<dim>& state, const Observer& observer) const;
  FinalWidths first_widths(const LevelSet<dim>& shape) const;
  bool has_widths(const LevelSet<dim>& shape, const FeatureSize& widths) const;
  std::vector<Trial<dim>> mended(const OptimizationState<dim>& state) const;
  Trial<dim> mended(const OptimizationState<dim>& state, const LevelSet<dim>& shape) const;
  OptimizationState<dim> begun_anew(OptimizationState<dim> state, const Trial<dim>& trial) const;
  std::optional<StopReason> descend(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const;
  Trial<dim> attempt(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                     const Move<dim>& move, int halvings) const;
  Trial<dim> attempt_at_rest(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                             Move<dim> move, int halvings) const;
  MadeCells evolve(const OptimizationState<dim>& state, const Move<dim>& move, Trial<dim>& trial) const;
  MadeCells finish(Trial<dim>& trial, std::optional<double> target, double boundary_measure,
                   const FeatureSize& widths) const;
  bool is_in_reach(double measure) const;
  void name_target(double from, double to, double target, Failure& failure) const;
  void add_changes(const LevelSet<dim>& before, Trial<dim>& trial) const;
  void evaluate(Trial<dim>& trial, MadeCells cells, const Evaluation<dim>* previous,
                const FeatureSize& widths) const;
  FeatureSize widths_after(const OptimizationState<dim>& state) const;
  bool is_due(int every, int since, int halvings) const;
  AcceptedShape accepted_shape(const Evaluation<dim>& evaluation) const;
  OptimizationState<dim> successor(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                                   const Move<dim>& move, const Trial<dim>& trial) const;

  Lattice<dim> lattice_;
  Evolver<dim> evolver_;
  OptimizerOptions options_;
  Evaluate evaluate_;
};

/// How a run ended: its last accepted shape, or why the initial shape failed.
template <int dim>
struct Outcome {
  StopReason reason;
  std::optional<OptimizationState<dim>> state;
  std::optional<Failure> failure;
};

/// start() and run().
template <int dim>
Outcome<dim> optimize(const ShapeOptimizer<dim>& optimizer, const LevelSet<dim>& initial,
                      const typename ShapeOptimizer<dim>::Observer& observer,
                      const std::function<bool()>& stop_requested);

}  // namespace wheelwright
