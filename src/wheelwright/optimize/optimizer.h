#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/evolver.h"
#include "wheelwright/sensitivity/evaluate.h"

namespace wheelwright {

/// How the measure of the material is held.
enum class MeasureControl {
  exact,         ///< measure-preserving velocity, then a shift of the level set to the target
  proportional,  ///< the paper's multiplier lambda_k and fixed step: every shape that can be evaluated, and
                 ///< whose objective does not jump, is accepted
};

struct OptimizerOptions {
  std::string objective = "objective";  ///< the name of the function that is minimized
  int iterations = 100;
  double step = 0.5;                ///< farthest that the boundary travels in one shape [cells]
  int max_halvings = 6;             ///< of the step, for one shape
  double largest_island = 0.01;     ///< share of the sector; smaller ones are removed, larger ones a failure
  double accepted_increase = 1e-4;  ///< of the objective over the best shape so far, relative
  double tolerance = 1e-5;  ///< converged when the objective falls by less over 10 shapes, relative; 0: never
  int redistance_every = 5;  ///< accepted shapes; 0: never
  int smooth_every = 0;      ///< accepted shapes; 0: never
  MeasureControl measure_control = MeasureControl::exact;
  std::optional<double> target_measure;  ///< of the material in one sector; absent: the initial shape's
  /// How far the measure moves towards the target in one shape at the full step, as a fraction of the whole
  /// sector; only when it is held exactly.
  double measure_rate = 0.01;
};

/// The last accepted shape and all that the next one depends on: a run that is resumed from a copy continues
/// identically.
template <int dim>
struct OptimizationState {
  LevelSet<dim> shape;
  Evaluation<dim> evaluation;  ///< of this shape
  double measure;              ///< of this shape's material, one sector
  double target_measure;
  int iteration;         ///< 0 for the initial shape
  double step;           ///< to be tried next [cells]
  int since_redistance;  ///< accepted shapes since the last redistancing
  int since_smoothing;
  std::vector<double> history;  ///< the objective of every accepted shape from history_begin on
  /// The last shape whose objective is not compared with those before it: the first, one at which the
  /// objective was changed, or one whose measure had not been the target's yet.
  int history_begin = 0;
};

enum class Verdict {
  accepted,
  failed,          ///< the shape could not be built or evaluated, or the objective jumped
  objective_rose,  ///< by more than accepted_increase
};

constexpr const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::failed:
      return "failed";
    case Verdict::objective_rose:
      return "objective_rose";
  }
  return "unknown";
}

/// One shape that was tried.
template <int dim>
struct Trial {
  int iteration;        ///< number of the shape that it wants to become; 0 for the initial shape
  int halvings;         ///< of the step, so far, for this iteration
  double step;          ///< [cells]; 0 for the initial shape, and where the boundary was not to move
  double max_velocity;  ///< fastest node, in units of the gradient density; 0 for the initial shape
  double evolution_seconds;
  LevelSet<dim> shape;  ///< as far as it could be built; at worst the last accepted one
  double measure;       ///< of the material, one sector; NaN when it was not reached
  Verdict verdict;
  std::optional<Evaluation<dim>> evaluation = {};  ///< empty when there is none
  std::optional<Failure> failure = {};             ///< set when failed
  std::vector<ShapeEvent<dim>> events =
      {};  ///< islands removed; when accepted, also what became of the holes of
           ///< the shape before: the given one for the initial shape
  /// What the evaluation was computed from; null when there was none.
  std::shared_ptr<const State<dim>> solution = {};
};

enum class StopReason {
  iterations,      ///< the number asked for is done
  converged,       ///< the objective hardly decreases any more
  no_descent,      ///< shapes were evaluated, but none, with the step halved max_halvings times, is better
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

/// Whether the measure is held exactly, but has not reached its target yet.
template <int dim>
bool is_approaching(const OptimizerOptions& options, const OptimizationState<dim>& state);

/// Why a run with these options goes no further than this state, if its number of shapes or its objectives
/// tell.
template <int dim>
std::optional<StopReason> reason_to_stop(const OptimizerOptions& options,
                                         const OptimizationState<dim>& state);

/// The velocity by which a state's shape moves next: that of its gradient, with the correction for the
/// measure that the options ask for.
template <int dim>
Expected<std::vector<double>> descent_velocity(const Evolver<dim>& evolver, const OptimizerOptions& options,
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

  /// Proceeds to the next accepted shape; a reason when there is none, the state then stays as it is.
  /// `stop_requested` is asked before every trial. The observer sees a failure of the velocity as a trial
  /// without a shape of its own.
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
  Trial<dim> attempt(const OptimizationState<dim>& state, std::span<const double> velocity, double step,
                     int halvings) const;
  Trial<dim> attempt_at_rest(const OptimizationState<dim>& state, std::span<const double> velocity,
                             int halvings) const;
  MadeCells evolve(const OptimizationState<dim>& state, std::span<const double> velocity,
                   Trial<dim>& trial) const;
  MadeCells finish(Trial<dim>& trial, std::optional<double> target, double boundary_measure) const;
  bool is_in_reach(double measure) const;
  double next_measure(const OptimizationState<dim>& state, double step) const;
  double foretold_change(const OptimizationState<dim>& state, std::span<const double> velocity,
                         double step) const;
  void name_target(double from, double to, double target, Failure& failure) const;
  bool is_acceptable(const OptimizationState<dim>& state, const Trial<dim>& trial) const;
  void add_changes(const LevelSet<dim>& before, Trial<dim>& trial) const;
  void evaluate(Trial<dim>& trial, MadeCells cells, const Evaluation<dim>* previous) const;
  bool is_due(int every, int since, int halvings) const;
  double next_step(const OptimizationState<dim>& state, const Trial<dim>& trial) const;
  OptimizationState<dim> successor(const OptimizationState<dim>& state, const Trial<dim>& trial) const;

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
