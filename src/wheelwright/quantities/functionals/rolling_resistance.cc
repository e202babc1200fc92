#include "wheelwright/quantities/functionals/rolling_resistance.h"

#include <numeric>

#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {
namespace {

/// The loss factors of the layers, 0 for those outside of a part.
template <int dim>
std::vector<double> loss_factors(const RollingModel<dim>& model, const std::optional<PartOfRing>& part) {
  const auto& layers = model.materials.layers();
  std::vector<double> factors;
  double inner = model.grid.inner_radius;
  for (const auto& layer : layers) {
    const double outer = &layer == &layers.back() ? model.grid.outer_radius : layer.outer_radius;
    const bool counts = !part || part->has_radius(0.5 * (inner + outer));
    factors.push_back(counts ? layer.law->loss_factor().value_or(0) : 0);
    inner = outer;
  }
  return factors;
}

/// The loss factor of all strain energy from which those of single layers differ: that at the tread, where
/// most of the losses are and the tread's refinement is only known to the energy. Cords store energy without
/// losses.
template <int dim>
double reference(const Materials<dim>& materials, const std::vector<double>& loss_factors) {
  return materials.cords().empty() ? loss_factors.back() : 0;
}

}  // namespace

template <int dim>
RollingResistance<dim>::RollingResistance(const RollingModel<dim>& model, std::optional<PartOfRing> part)
    : part_(std::move(part)) {
  const auto factors = loss_factors(model, part_);
  loss_factor_ = reference(model.materials, factors);
  for (std::size_t layer = 0; layer < factors.size(); ++layer)
    if (const double difference = factors[layer] - loss_factor_; difference != 0)
      differences_.push_back(
          std::make_shared<const LossDensity<dim>>(model, static_cast<int>(layer), difference));
}

template <int dim>
FunctionalValue<dim> RollingResistance<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                      const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  double resistance = 0;
  if (loss_factor_ != 0) {
    const std::vector<double>& energy = state.energy_by_harmonic();
    value.derivative.energy_by_harmonic =
        forces_by_energy(solver.model().grid, static_cast<int>(energy.size()), loss_factor_);
    resistance =
        std::inner_product(energy.begin(), energy.end(), value.derivative.energy_by_harmonic.begin(), 0.0);
  }
  for (const auto& difference : differences_) {
    const auto by_position = material_integral<dim>(solver, state, *difference);
    resistance = std::accumulate(by_position.begin(), by_position.end(), resistance);
    value.derivative.integrals.push_back({difference, std::vector<double>(by_position.size(), 1.0)});
  }
  value.over_positions = resistance;
  return value;
}

template class RollingResistance<2>;
template class RollingResistance<3>;

}  // namespace wheelwright
