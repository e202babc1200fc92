#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/feature_size.h"
#include "wheelwright/geometry/topology.h"
#include "wheelwright/optimize/curvature_memory.h"
#include "wheelwright/sensitivity/evaluate.h"

namespace wheelwright {

/// How the measure of the material is held.
enum class MeasureControl {
  exact,         ///< measure-preserving velocity, then a shift of the level set to the target
  free,          ///< it moves with the boundary
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

struct OptimizerOptions {
  Method method = Method::descent;
  std::string objective = "objective";  ///< the name of the function that is minimized
  int iterations = 100;
  double step = 0.5;                ///< farthest that the boundary travels in one shape [cells]
  int max_halvings = 6;             ///< of the step, for one shape
  double largest_island = 0.01;     ///< share of the sector; smaller ones are removed, larger ones a failure
  double accepted_increase = 1e-4;  ///< of the objective over the best shape so far, relative
  double tolerance = 1e-5;   ///< relative fall of the objective that has_converged() looks for; 0: never
  int redistance_every = 5;  ///< accepted shapes; 0: never
  int smooth_every = 0;      ///< accepted shapes; 0: never
  MeasureControl measure_control = MeasureControl::exact;
  std::optional<double> target_measure;  ///< of the material in one sector; absent: the initial shape's
  /// How far the measure moves towards the target in one shape at the full step, as a fraction of the whole
  /// sector; only when it is held exactly.
  double measure_rate = 0.01;
  /// The least widths in the last part of a run. Until the descent slows, or two thirds of the shapes are
  /// done, shapes need not have them; then one is mended, and all that follow have them. A first shape whose
  /// holes are only about two cells wide, and that has these widths, keeps them from the beginning.
  FeatureSize final_widths = {};
};

/// Whether shapes have OptimizerOptions::final_widths.
enum class FinalWidths {
  not_yet,
  kept,
  impossible,  ///< no shape that has them could be evaluated
};

/// An accepted shape, as far as the state remembers it.
struct AcceptedShape {
  double objective;
  double violation = 0;  ///< largest_violation() of its bounds
  int trials = 0;        ///< that led from it to the next one, rejected ones included; 0 at the last shape

  bool operator==(const AcceptedShape&) const = default;
};

/// What a method learns from the shapes before.
struct StepMemory {
  CurvatureMemory pairs;
  std::vector<double> penalties;    ///< of the constraints, in their order
  std::vector<double> multipliers;  ///< of the constraints, at the last step
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
  StepMemory memory;                   ///< of the method
  std::vector<AcceptedShape> history;  ///< every accepted shape from history_begin on
  /// The last shape whose objective is not compared with those before it: the first, one at which the
  /// objective was changed, or one whose measure had not been the target's yet.
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

/// One shape that was tried.
template <int dim>
struct Trial {
  int iteration;         ///< number of the shape that it wants to become; 0 for the initial shape
  int halvings;          ///< of the step, so far, for this iteration
  double step;           ///< [cells]; 0 for the initial shape, and where the boundary was not to move
  double predicted = 0;  ///< decrease of the merit function by the method's model; 0 where none was made
  double max_velocity;   ///< fastest node, in units of the gradient density; 0 for the initial shape
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
  StatesOfCases<dim> other_solutions = {};  ///< under the load cases that follow the first
};

/// The least widths of the shapes that follow a state, where all shapes have those given.
template <int dim>
FeatureSize widths_after(const FeatureSize& of_all, const OptimizerOptions& options,
                         const OptimizationState<dim>& state) {
  return state.final_widths == FinalWidths::kept ? larger(of_all, options.final_widths) : of_all;
}

/// Whether the measure is held exactly, but has not reached its target yet.
template <int dim>
bool is_approaching(const OptimizerOptions& options, const OptimizationState<dim>& state);

/// What the measure becomes with the next shape, when its boundary moves by `step` cells.
template <int dim>
double next_measure(const OptimizerOptions& options, const OptimizationState<dim>& state, double step);

}  // namespace wheelwright
