#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "wheelwright/mechanics/elasticity/fatigue_strength.h"

namespace wheelwright {

// Damage of a material point by Miner's rule (M. A. Miner, J. Appl. Mech. 12, 1945): a turn like those of
// which it bears N uses up 1 / N of its life, whatever it has borne before. The exponent of the strength must
// be known.

/// The damage of a turn on average, if these shares of the distance are driven under load cases with these
/// utilizations of the point.
inline double damage_per_turn(const FatigueStrength& strength, std::span<const double> utilizations,
                              std::span<const double> shares) {
  double damage = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) damage += shares[k] / *strength.life(utilizations[k]);
  return damage;
}

/// The utilization at which every turn does this damage.
inline double equivalent_utilization(const FatigueStrength& strength, double damage) {
  return std::pow(strength.cycles * damage, 1 / *strength.exponent);
}

}  // namespace wheelwright
