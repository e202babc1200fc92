#pragma once

#include <cmath>
#include <optional>

namespace wheelwright {

/// What is compared with the fatigue limit: a function of the stresses or strains of a material point over a
/// turn of the wheel.
enum class FatigueMeasure {
  none,
  crossland,         ///< for metals: amplitude of the root of J2, and the largest hydrostatic stress
  dang_van,          ///< for metals: largest shear stress about the mean of the turn, and hydrostatic stress
  goodman,           ///< for plastics: amplitude of the signed von Mises stress, with its mean by Goodman
  principal_strain,  ///< for elastomers: largest principal strain
  strain_energy,     ///< for elastomers: largest strain energy density
};

/// What a material bears over many turns: a curve of Woehler, N = cycles (limit / measure)^exponent.
struct FatigueStrength {
  FatigueMeasure measure = FatigueMeasure::none;
  double limit = 0;                              ///< the measure endured for `cycles` [Pa, J/m^3 or 1]
  double cycles = 1e6;                           ///< turns
  std::optional<double> exponent = {};           ///< without it no life is known
  double pressure_factor = 0;                    ///< alpha of crossland and dang_van
  std::optional<double> ultimate_strength = {};  ///< of goodman [Pa]

  bool operator==(const FatigueStrength&) const = default;

  /// Life in turns at a utilization, the measure by its limit; infinite at 0.
  std::optional<double> life(double utilization) const {
    return exponent ? std::optional(cycles * std::pow(utilization, -*exponent)) : std::nullopt;
  }
};

}  // namespace wheelwright
