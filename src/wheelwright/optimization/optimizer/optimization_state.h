#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/optimization/optimizer/curvature_memory.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/shape/evolution/feature_size.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

/// How the measure of the material is controlled.
enum class MeasureControl {
  exact,         ///< measure-preserving velocity, then a shift of the level set to the target
  free,          ///< changes with the boundary
  proportional,  ///< the paper's multiplier lambda_k and fixed step: every shape that can be evaluated, and
                 ///< whose objective does not jump, is accepted
};

/// How the next shape is found.
enum class Method {
  descent,               ///< along the gradient, corrected for the measure (descent.h)
  sequential_quadratic,  ///< a quadratic model with linearized constraints (sequential_quadratic.h)
};

constexpr const char* to_string(Method method) {
  return method == Method::descent ? "descent" : "sequential_quadratic";
}

/// The radius of a line of the grid that is chosen together with the shape.
struct DesignLine {
  int line;            ///< a fixed line of the grid, counted from the rim
  double least, most;  ///< of its radius [m]
};

struct OptimizerOptions {
  Method method = Method::descent;
  std::string objective = "objective";  ///< the name of the function that is minimized
  int iterations = 100;
  double step = 0.5;     ///< maximum motion of the boundary in one shape [cells]
  int max_halvings = 6;  ///< of the step, for one shape
  double largest_island =
      0.01;  ///< fraction of the sector; smaller islands are removed, larger ones are a failure
  double accepted_increase = 1e-4;  ///< of the objective over the best shape so far, relative
  double tolerance = 1e-5;   ///< relative decrease of the objective below which has_converged(); 0: never
  int redistance_every = 5;  ///< accepted shapes; 0: never
  int smooth_every = 0;      ///< accepted shapes; 0: never
  MeasureControl measure_control = MeasureControl::exact;
  std::optional<double> target_measure;  ///< of the material in one sector; absent: the initial shape's
  /// How far the measure moves towards the target in one shape at the full step, as a fraction of the whole
  /// sector; only if it is controlled exactly.
  double measure_rate = 0.01;
  /// The minimum widths in the last part of a run. Until the descent slows, or two thirds of the shapes are
  /// done, shapes need not have them; then one is repaired, and all later shapes have them. If the first
  /// shape has holes only about two cells wide, and has these widths, they are enforced from the start.
  FeatureSize final_widths = {};
  /// The radius of internal corners of a wheel whose shapes cannot have that of `final_widths`, e.g. because
  /// its holes are smaller.
  double sharper_radius = 0;
  /// The design lines of the evaluation's model, in its order. They need sequential quadratic steps, and a
  /// ShapeOptimizer that moves lines.
  std::vector<DesignLine> design_lines = {};
};

/// Whether OptimizerOptions::final_widths are enforced.
enum class FinalWidths {
  not_yet,
  kept,
  impossible,  ///< no shape that has them could be evaluated
  kept_with_sharper_corners,
};

/// What the state remembers of an accepted shape.
struct AcceptedShape {
  double objective;
  double violation = 0;  ///< largest_violation() of its bounds
  int trials = 0;        ///< from it to the next one, including rejected ones; 0 for the last shape

  bool operator==(const AcceptedShape&) const = default;
};

/// What a method has learned from earlier shapes.
struct StepMemory {
  CurvatureMemory pairs;
  std::vector<double> penalties;    ///< of the constraints, in their order
  std::vector<double> multipliers;  ///< of the constraints, at the last step
};

/// The last accepted shape and everything that the next one depends on: a run resumed from a copy continues
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
  StepMemory memory;                   ///< of the method
  std::vector<AcceptedShape> history;  ///< every accepted shape from history_begin on
  /// The last shape whose objective is not compared with earlier ones: the first, one at which the objective
  /// was changed, or one whose measure had not reached the target.
  int history_begin = 0;
  FinalWidths final_widths = FinalWidths::not_yet;
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

/// A trial shape.
template <int dim>
struct Trial {
  int iteration;         ///< number that the shape gets if accepted; 0 for the initial shape
  int halvings;          ///< of the step, so far, for this iteration
  double step;           ///< [cells]; 0 for the initial shape, and if the boundary is not to move
  double predicted = 0;  ///< decrease of the merit function by the method's model; 0 if there is no model
  double max_velocity;   ///< fastest node, in units of the gradient density; 0 for the initial shape
  double evolution_seconds;
  LevelSet<dim> shape;  ///< as far as it could be built; at worst the last accepted shape
  double measure;       ///< of the material, one sector; NaN when it was not reached
  Verdict verdict;
  std::optional<Evaluation<dim>> evaluation = {};  ///< empty when there is none
  std::optional<Failure> failure = {};             ///< set when failed
  std::vector<ShapeEvent<dim>> events = {};  ///< islands removed; if accepted, also changes of the holes of
                                             ///< the shape before: the given one for the initial shape
  /// What the evaluation was computed from; null if there is none.
  std::shared_ptr<const State<dim>> solution = {};
  StatesOfCases<dim> other_solutions = {};  ///< under the load cases that follow the first
};

/// The state in which the smallest final radius of corners is enforced.
inline FinalWidths with_sharpest_corners(const OptimizerOptions& options) {
  return options.sharper_radius == options.final_widths.radius ? FinalWidths::kept
                                                               : FinalWidths::kept_with_sharper_corners;
}

/// The final widths that are enforced; 0 where none are.
inline FeatureSize enforced_widths(const OptimizerOptions& options, FinalWidths final_widths) {
  FeatureSize result = options.final_widths;
  if (final_widths == FinalWidths::kept) return result;
  if (final_widths != FinalWidths::kept_with_sharper_corners) return {};
  result.radius = options.sharper_radius;
  return result;
}

/// The minimum widths of the shapes after a state; `of_all`: those of every shape.
template <int dim>
FeatureSize widths_after(const FeatureSize& of_all, const OptimizerOptions& options,
                         const OptimizationState<dim>& state) {
  return larger(of_all, enforced_widths(options, state.final_widths));
}

/// Whether the measure is controlled exactly but has not reached its target yet.
template <int dim>
bool is_approaching(const OptimizerOptions& options, const OptimizationState<dim>& state);

/// The measure of the next shape if its boundary moves by `step` cells.
template <int dim>
double next_measure(const OptimizerOptions& options, const OptimizationState<dim>& state, double step);

}  // namespace wheelwright
