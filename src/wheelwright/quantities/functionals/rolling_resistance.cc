#include "wheelwright/quantities/functionals/rolling_resistance.h"

#include <algorithm>
#include <numeric>

#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/turn_harmonics.h"

namespace wheelwright {
namespace {

/// The loss factors of the layers, 0 for those outside of a part.
template <int dim>
std::vector<LossFactor> factors_of_layers(const RollingModel<dim>& model,
                                          const std::optional<PartOfRing>& part) {
  const auto& layers = model.materials.layers();
  std::vector<LossFactor> factors;
  double inner = model.grid.inner_radius;
  for (const auto& layer : layers) {
    const double outer = &layer == &layers.back() ? model.grid.outer_radius : layer.outer_radius;
    const bool counts = !part || part->has_radius(0.5 * (inner + outer));
    factors.push_back(counts ? layer.law->loss_factor().value_or(0) : LossFactor(0));
    inner = outer;
  }
  return factors;
}

/// The loss factor of all strain energy from which those of single layers differ: that at the tread, where
/// most of the losses are and the tread's refinement is only known to the energy. Cords store energy without
/// losses.
template <int dim>
LossFactor reference(const Materials<dim>& materials, const std::vector<LossFactor>& of_layers) {
  return materials.cords().empty() ? of_layers.back() : LossFactor(0);
}

bool are_zero(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return value == 0; });
}

}  // namespace

template <int dim>
RollingResistance<dim>::RollingResistance(const RollingModel<dim>& model, std::optional<PartOfRing> part)
    : part_(std::move(part)),
      of_layers_(factors_of_layers(model, part_)),
      of_all_(reference(model.materials, of_layers_)) {}

template <int dim>
FunctionalValue<dim> RollingResistance<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                      const State<dim>& state, const Matrix&) const {
  const RollingModel<dim>& model = state.model();
  const int n_harmonics = TurnHarmonics(model.n_positions, model.grid.n_sectors).n_harmonics();
  const std::vector<double> of_all = loss_factors(model, n_harmonics, of_all_);
  FunctionalValue<dim> value;
  double resistance = 0;
  if (!are_zero(of_all)) {
    const std::vector<double>& energy = state.energy_by_harmonic();
    value.derivative.energy_by_harmonic = forces_by_energy<dim>(model.grid, of_all);
    resistance =
        std::inner_product(energy.begin(), energy.end(), value.derivative.energy_by_harmonic.begin(), 0.0);
  }
  for (std::size_t layer = 0; layer < of_layers_.size(); ++layer) {
    std::vector<double> differences = loss_factors(model, n_harmonics, of_layers_[layer]);
    for (int n = 0; n < n_harmonics; ++n) differences[n] -= of_all[n];
    if (are_zero(differences)) continue;
    const auto density =
        std::make_shared<const LossDensity<dim>>(model, static_cast<int>(layer), differences);
    const auto by_position = material_integral<dim>(solver, state, *density);
    resistance = std::accumulate(by_position.begin(), by_position.end(), resistance);
    value.derivative.integrals.push_back({density, std::vector<double>(by_position.size(), 1.0)});
  }
  value.over_positions = resistance;
  return value;
}

template class RollingResistance<2>;
template class RollingResistance<3>;

}  // namespace wheelwright
