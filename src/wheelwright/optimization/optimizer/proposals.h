#pragma once

#include <memory>
#include <vector>

#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/shape/evolution/evolver.h"

namespace wheelwright {

/// A motion of a state's boundary proposed by a method.
template <int dim>
struct Move {
  std::vector<double> velocity;  ///< along the outward normal of the material, at the nodes
  /// From which it was derived, if any: that of the shape, then the changes of the radii of design lines.
  std::vector<double> deformation = {};
  std::vector<double> radii = {};  ///< of the design lines after the move; empty: they stay [m]
  double distance;                 ///< motion of the fastest node [cells]
  double step;     ///< motion of the boundary, or of the fastest node, depending on the method [cells]
  double radius;   ///< maximum requested step [cells]
  double measure;  ///< intended measure of the material
  double objective_change;  ///< predicted to first order
  double model_decrease;    ///< of the merit function, predicted by the method's model
  std::vector<double> multipliers = {};
  std::vector<double> penalties = {};
  std::vector<double> gaps = {};  ///< predicted for bound_constraints(), in their order
};

/// The proposals of a method from one state, which must outlive this.
template <int dim>
class Proposals {
 public:
  virtual ~Proposals() = default;

  /// The move by at most `step` cells, if bounds are nearer after it by `bends` than their derivatives say,
  /// in the order of bound_constraints(); none if empty.
  virtual Expected<Move<dim>> move(double step, const std::vector<double>& bends = {}) const = 0;

  /// By how much bounds are nearer at the shape of a rejected move than was predicted, if a move with these
  /// bends may be accepted where this one was not; otherwise empty.
  virtual std::vector<double> bends(const Move<dim>& move, const Evaluation<dim>& evaluation) const = 0;

  /// Whether the shape after the move is good enough to continue from.
  virtual bool accepts(const Move<dim>& move, const Evaluation<dim>& evaluation) const = 0;

  /// The first step to try from an accepted shape [cells].
  virtual double next_step(const Move<dim>& move, const Evaluation<dim>& evaluation) const = 0;

  /// The memory at an accepted shape, which `evolver` moves.
  virtual StepMemory remembered(const Move<dim>& move, const LevelSet<dim>& shape,
                                const Evaluation<dim>& evaluation, const Evolver<dim>& evolver) const = 0;
};

/// Creates the proposals of the method in the options. Fails like the extension of a gradient.
template <int dim>
Expected<std::unique_ptr<Proposals<dim>>> proposals_from(const Evolver<dim>& evolver,
                                                         const OptimizerOptions& options,
                                                         const OptimizationState<dim>& state);

}  // namespace wheelwright
