#include "wheelwright/optimization/optimizer/descent.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

constexpr double step_growth = 1.5;
constexpr double overshoot_reduction = 0.5;

}  // namespace

template <int dim>
Expected<std::vector<double>> descent_velocity(const Evolver<dim>& evolver, const OptimizerOptions& options,
                                               const OptimizationState<dim>& state) {
  auto gradient = state.evaluation.gradient(options.objective);
  if (options.measure_control == MeasureControl::free) return evolver.velocity(gradient);
  if (options.measure_control == MeasureControl::exact) return evolver.measure_preserving_velocity(gradient);
  const double whole = sector_measure<dim>(state.shape.lattice.grid());
  const double multiplier =
      proportional_multiplier<dim>(gradient, state.target_measure / whole, state.measure / whole);
  for (auto& sample : gradient) sample.value -= multiplier;
  return evolver.velocity(gradient);
}

template <int dim>
DescentProposals<dim>::DescentProposals(const Evolver<dim>& evolver, const OptimizerOptions& options,
                                        const OptimizationState<dim>& state, std::vector<double> velocity)
    : evolver_(evolver), options_(options), state_(state), velocity_(std::move(velocity)) {}

template <int dim>
Expected<Move<dim>> DescentProposals<dim>::move(double step, const std::vector<double>&) const {
  const bool stands = std::ranges::all_of(velocity_, [](double v) { return v == 0; });
  const double change = stands ? 0 : predicted_change(step);
  return Move<dim>{.velocity = velocity_,
                   .distance = stands ? 0 : step,
                   .step = stands ? 0 : step,
                   .radius = step,
                   .measure = next_measure(options_, state_, step),
                   .objective_change = change,
                   .model_decrease = -change};
}

/// First-order change of the objective under the motion by the velocity and the uniform shift of the boundary
/// to the next measure.
template <int dim>
double DescentProposals<dim>::predicted_change(double step) const {
  const auto gradient = state_.evaluation.gradient(options_.objective);
  const double by_motion =
      evolver_.first_order_change(gradient, velocity_, step * state_.shape.lattice.grid().resolution());
  if (!is_approaching(options_, state_)) return by_motion;
  double sum = 0, boundary = 0;
  for (const auto& sample : gradient) {
    sum += sample.weight * sample.value;
    boundary += sample.weight;
  }
  return by_motion + (next_measure(options_, state_, step) - state_.measure) * sum / boundary;
}

template <int dim>
std::vector<double> DescentProposals<dim>::bends(const Move<dim>&, const Evaluation<dim>&) const {
  return {};
}

template <int dim>
bool DescentProposals<dim>::accepts(const Move<dim>&, const Evaluation<dim>& evaluation) const {
  if (options_.measure_control == MeasureControl::proportional || is_approaching(options_, state_))
    return true;
  const double best = std::ranges::min_element(state_.history, {}, &AcceptedShape::objective)->objective;
  return evaluation.function(options_.objective).value <= best + options_.accepted_increase * std::abs(best);
}

/// An accepted step that raised the objective went past the minimum along its direction.
template <int dim>
double DescentProposals<dim>::next_step(const Move<dim>& move, const Evaluation<dim>& evaluation) const {
  const bool overshot =
      options_.measure_control == MeasureControl::exact && !is_approaching(options_, state_) &&
      evaluation.function(options_.objective).value > state_.evaluation.function(options_.objective).value;
  const double step = move.step * (overshot ? overshoot_reduction : step_growth);
  return std::clamp(step, std::ldexp(options_.step, -options_.max_halvings), options_.step);
}

template <int dim>
StepMemory DescentProposals<dim>::remembered(const Move<dim>&, const LevelSet<dim>&, const Evaluation<dim>&,
                                             const Evolver<dim>&) const {
  return {};
}

template decltype(descent_velocity<2>) descent_velocity<2>;
template decltype(descent_velocity<3>) descent_velocity<3>;
template class DescentProposals<2>;
template class DescentProposals<3>;

}  // namespace wheelwright
