#pragma once

#include <span>
#include <vector>

#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {

// The force that keeps a wheel rolling against the losses of its material [N/m when dim = 2, N when dim = 3].
// In a turn, in which the wheel moves on by 2 pi R_e, a material of loss factor tan(delta) loses in harmonic
// n of its strains the energy 4 pi n tan(delta) W_n, with W_n of State::energy_by_harmonic(). All positions
// of the sector must have been solved. Cords have no losses. Harmonic n has n times the frequency of the
// turns at the model's speed; without a speed it is 0.

/// Whether the loss factor of every material is known.
template <int dim>
bool has_loss_factors(const Materials<dim>& materials);

/// A loss factor in the harmonics 0 ... n_harmonics - 1 of the turn of a model's wheel.
template <int dim>
std::vector<double> loss_factors(const RollingModel<dim>& model, int n_harmonics,
                                 const LossFactor& loss_factor);

/// The forces by the energies W_n of the harmonics: 2 n / R_e times their loss factors [1/m].
template <int dim>
std::vector<double> forces_by_energy(const PolarGrid<dim>& grid, std::span<const double> loss_factors);

/// The shares of the load cases in the force, as a density of the material of one layer: their sum,
/// integrated over the layer, is the force.
template <int dim>
class LossDensity : public MaterialDensity<dim> {
 public:
  /// Of one of the model's layers, with these factors of the harmonics in place of the layer's loss factor.
  LossDensity(const RollingModel<dim>& model, int layer, std::span<const double> loss_factors);
  /// With this loss factor, at the model's speed.
  LossDensity(const RollingModel<dim>& model, int layer, const LossFactor& loss_factor);

  Matrix densities(const StrainsInCell<dim>& cell) const override;
  Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const override;
  bool covers(const PolarGrid<dim>& grid, int row) const override;

 private:
  Materials<dim> materials_;
  int layer_;
  Matrix filter_;  ///< over pairs of load cases: force by the energy of one strain in the stress of the other
};

/// The same in a layer of a given loss factor, at the model's speed, summed over the load cases.
template <int dim>
class LossOfTurn {
 public:
  LossOfTurn(const RollingModel<dim>& model, const LossFactor& loss_factor);

  /// At the points of a cell [N/m^3].
  std::vector<double> densities(const StrainsInCell<dim>& cell) const;

 private:
  Matrix waves_;                 ///< TurnHarmonics::waves(), transposed
  std::vector<double> factors_;  ///< force by the energy of a wave
};

/// The force by layers of the model's materials, from the rim to the tread, and by harmonics of the turn, 0
/// ... N / 2: [layer][harmonic].
template <int dim>
std::vector<std::vector<double>> resistance_of_layers(const StateSolver<dim>& solver,
                                                      const State<dim>& state);

/// An estimate of what the harmonics above N / 2 would add to a force by harmonics: as much as those of the
/// last octave, which is a bound if the energies fall at least as the third power of the harmonic. Near an
/// elastic contact they fall as the fourth. 0 if it is less than the rounding of the sum.
double resistance_beyond(std::span<const double> by_harmonic);

}  // namespace wheelwright
