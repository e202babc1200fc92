#pragma once

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/optimizer/design_space.h"
#include "wheelwright/optimization/optimizer/proposals.h"
#include "wheelwright/optimization/optimizer/quadratic_step.h"
#include "wheelwright/shape/evolution/widths.h"

namespace wheelwright {

/// Sequential quadratic steps with a trust region. A move is a deformation theta that minimizes the model
/// DJ(theta) + (theta, B theta) / 2 of the merit function under the linearized measure and bounds of
/// functions, where B is the L-BFGS matrix of the Lagrangian in the inner product of deformations
/// (shape/evolution/deformation_space.h), and no point of the boundary moves farther than the step. The step
/// shrinks if the model predicts poorly and grows if it predicts well. Bounds that cannot be met within a
/// step are relaxed; their penalties grow until the step does about as much for them as possible. A move that
/// is rejected because a bound curves is repeated with the bound as it was found (the second-order correction
/// of Fletcher 1982), without which steps along a bound shrink to nothing (Maratos 1978). Widths that
/// a step could bring below their minimum are constraints too, with a penalty so large that they take
/// priority.
template <int dim>
class SequentialQuadraticProposals final : public Proposals<dim> {
 public:
  SequentialQuadraticProposals(const Evolver<dim>& evolver, const OptimizerOptions& options,
                               const OptimizationState<dim>& state);

  Expected<Move<dim>> move(double step, const std::vector<double>& bends = {}) const override;
  std::vector<double> bends(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  bool accepts(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  double next_step(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  StepMemory remembered(const Move<dim>& move, const LevelSet<dim>& shape, const Evaluation<dim>& evaluation,
                        const Evolver<dim>& evolver) const override;

 private:
  /// Deformations and their loads: the representatives of derivatives, then the moves of the pairs, then
  /// their changes.
  struct Span {
    std::vector<std::vector<double>> deformations, loads;
    Matrix known = {};  ///< the products of its last vectors
    Matrix products() const;
  };

  Span span_of(const BoundaryMotion<dim>& motion) const;
  Move<dim> move_with(const std::vector<bool>& held, const Following& following, double step,
                      const std::vector<double>& bends) const;
  QuadraticStep step_in(const BoundaryMotion<dim>& motion, const Span& span, double gap, double step,
                        const std::vector<double>& bends, std::vector<double>& penalties) const;
  std::vector<double> penalties() const;
  double noise() const;
  std::vector<double> speeds(const BoundaryMotion<dim>& motion, std::span<const double> deformation) const;
  std::vector<double> radii_after(std::vector<double>& deformation) const;

  const Evolver<dim>& evolver_;
  const OptimizerOptions& options_;
  const OptimizationState<dim>& state_;
  DesignSpace<dim> space_;
  std::vector<BoundConstraint> constraints_;
  std::vector<Width<dim>> widths_;  ///< that a step could bring below their minimum
  BoundaryMotion<dim> motion_;      ///< of the state's shape
  Span pairs_;                      ///< of the state's memory
  /// Those of the span before, without pairs: most shorter steps and moves with more coefficients held have
  /// many of the same loads.
  mutable Span derivatives_;
};

}  // namespace wheelwright
