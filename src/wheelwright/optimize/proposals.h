#pragma once

#include <memory>
#include <vector>

#include "wheelwright/evolution/evolver.h"
#include "wheelwright/optimize/optimization_state.h"

namespace wheelwright {

/// A motion of a state's boundary that a method wants to try.
template <int dim>
struct Move {
  std::vector<double> velocity;          ///< along the outward normal of the material, at the nodes
  std::vector<double> deformation = {};  ///< that it comes from, where the method has one
  double distance;                       ///< how far the fastest node travels [cells]
  double step;     ///< how far the boundary travels, or the fastest node, as the method counts [cells]
  double radius;   ///< the most that it was asked for [cells]
  double measure;  ///< what the measure of the material is to become
  double objective_change;  ///< predicted to first order
  double model_decrease;    ///< of the merit function, predicted by the method's model
  std::vector<double> multipliers = {};
  std::vector<double> penalties = {};
};

/// What a method proposes from one state, which must live as long.
template <int dim>
class Proposals {
 public:
  virtual ~Proposals() = default;

  /// The move by at most `step` cells.
  virtual Expected<Move<dim>> move(double step) const = 0;

  /// Whether the shape that the move led to is good enough to go on from.
  virtual bool accepts(const Move<dim>& move, const Evaluation<dim>& evaluation) const = 0;

  /// The step to be tried first from an accepted shape [cells].
  virtual double next_step(const Move<dim>& move, const Evaluation<dim>& evaluation) const = 0;

  /// What is to be remembered at an accepted shape.
  virtual StepMemory remembered(const Move<dim>& move, const LevelSet<dim>& shape,
                                const Evaluation<dim>& evaluation) const = 0;
};

/// By the method of the options. Fails as the extension of a gradient does.
template <int dim>
Expected<std::unique_ptr<Proposals<dim>>> proposals_from(const Evolver<dim>& evolver,
                                                         const OptimizerOptions& options,
                                                         const OptimizationState<dim>& state);

}  // namespace wheelwright
