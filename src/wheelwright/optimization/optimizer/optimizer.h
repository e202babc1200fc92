#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/optimization/optimizer/proposals.h"
#include "wheelwright/optimization/optimizer/trials.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/shape/evolution/evolver.h"

namespace wheelwright {

enum class StopReason {
  iterations,      ///< the requested number is done
  converged,       ///< the objective hardly decreases any more
  no_descent,      ///< no shape, with the step halved max_halvings times, is better and has its widths
  gave_up,         ///< no step, halved max_halvings times, gave a shape that could be evaluated; or not
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

/// Why a run with these options ends at this state, if that follows from its number of shapes or its
/// objectives.
template <int dim>
std::optional<StopReason> reason_to_stop(const OptimizerOptions& options,
                                         const OptimizationState<dim>& state);

/// Gradient descent on shapes: velocity, transport, redistancing and smoothing when due, measure, removal of
/// islands, evaluation. A measure that differs from the target approaches it by at most measure_rate per
/// shape, in proportion to the step. Objectives at different measures are not compared: until the target is
/// reached, every shape that can be evaluated, and whose objective does not jump, is accepted. The step is
/// halved if a trial is rejected, and for the next shape if the objective rose by an accepted amount; after a
/// decrease it grows by half. If a trial with redistancing or smoothing is rejected, they are postponed to
/// the next shape.
template <int dim>
class ShapeOptimizer {
 public:
  /// If it fails with `interrupted`, that does not count as a failed trial: the trial is discarded and the
  /// loop stops as if requested.
  using Evaluate = EvaluateShape<dim>;
  /// Sees every trial, accepted or rejected, and the state after it.
  using Observer = std::function<void(const Trial<dim>&, const OptimizationState<dim>&)>;

  ShapeOptimizer(const Lattice<dim>& lattice, const EvolutionOptions& evolution,
                 const OptimizerOptions& options, Evaluate evaluate);

  /// In the setting of one grid, with those of the grids to which design lines move.
  ShapeOptimizer(const PolarGrid<dim>& grid, Setting<dim> setting, const OptimizerOptions& options,
                 SettingOn<dim> setting_on);

  /// The same optimizer with another evaluation of the same functions.
  ShapeOptimizer with(Evaluate evaluate) const;

  /// The same optimizer on a grid whose design lines have other radii. Fails as SettingOn does.
  Expected<ShapeOptimizer> on(const PolarGrid<dim>& grid) const;

  /// Evaluates the initial shape, clipped at the protected bands. It is shifted to the target measure if that
  /// is given, controlled exactly, and within measure_rate. The observer sees it as iteration 0.
  Expected<OptimizationState<dim>> start(const LevelSet<dim>& initial, const Observer& observer) const;

  /// The state's shape evaluated with this objective, instead of the one with which it was found. Step and
  /// history are reset. The observer sees it as a trial of the same iteration.
  Expected<OptimizationState<dim>> restart(const OptimizationState<dim>& state,
                                           const Observer& observer) const;

  /// Proceeds to the next accepted shape, by a step or by repairing the final widths; if there is none,
  /// returns the reason and leaves the state unchanged. `stop_requested` is called before every trial. The
  /// observer sees a failure of the velocity as a trial without its own shape.
  std::optional<StopReason> advance(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const;

  /// Advances until there is a reason to stop.
  StopReason run(OptimizationState<dim>& state, const Observer& observer,
                 const std::function<bool()>& stop_requested) const;

  /// Of the shapes on its own grid.
  const Evolver<dim>& evolver() const { return trials_.evolver(); }

  /// The value that is minimized.
  double objective_of(const Evaluation<dim>& evaluation) const;

 private:
  enum class Repair { nothing, done, interrupted };
  Repair repair_widths(OptimizationState<dim>& state, const Observer& observer) const;
  FinalWidths first_widths(const LevelSet<dim>& shape) const;
  bool begins_with_sharp_corners(const OptimizationState<dim>& state) const;
  bool has_widths(const LevelSet<dim>& shape, const FeatureSize& widths) const;
  OptimizationState<dim> restarted(OptimizationState<dim> state, const Trial<dim>& trial) const;
  OptimizationState<dim> with_new_model(OptimizationState<dim> state) const;
  std::optional<StopReason> descend(OptimizationState<dim>& state, const Observer& observer,
                                    const std::function<bool()>& stop_requested) const;
  AcceptedShape accepted_shape(const Evaluation<dim>& evaluation) const;
  OptimizationState<dim> successor(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                                   const Move<dim>& move, const Trial<dim>& trial) const;

  OptimizerOptions options_;
  Trials<dim> trials_;
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
