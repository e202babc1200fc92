#pragma once

#include "wheelwright/optimization/optimizer/proposals.h"

namespace wheelwright {

/// The velocity of steepest descent from a state: that of its gradient, with the correction for the measure
/// selected by the options.
template <int dim>
Expected<std::vector<double>> descent_velocity(const Evolver<dim>& evolver, const OptimizerOptions& options,
                                               const OptimizationState<dim>& state);

/// Steepest descent. Objectives at different measures are not compared: until the target is reached, every
/// shape is accepted. For the next shape the step is halved if the objective rose by an accepted amount;
/// after a decrease it grows by half.
template <int dim>
class DescentProposals final : public Proposals<dim> {
 public:
  DescentProposals(const Evolver<dim>& evolver, const OptimizerOptions& options,
                   const OptimizationState<dim>& state, std::vector<double> velocity);

  Expected<Move<dim>> move(double step, const std::vector<double>& bends = {}) const override;
  std::vector<double> bends(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  bool accepts(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  double next_step(const Move<dim>& move, const Evaluation<dim>& evaluation) const override;
  StepMemory remembered(const Move<dim>& move, const LevelSet<dim>&, const Evaluation<dim>& evaluation,
                        const Evolver<dim>& evolver) const override;

 private:
  double predicted_change(double step) const;

  const Evolver<dim>& evolver_;
  const OptimizerOptions& options_;
  const OptimizationState<dim>& state_;
  std::vector<double> velocity_;
};

}  // namespace wheelwright
