#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// A term of the weighted sum, and the key of its weight, which has the quantity's name.
struct ObjectiveWeight {
  std::string_view quantity;
  double Objective::*weight;
};

/// In the order of the terms.
inline constexpr std::array<ObjectiveWeight, 4> objective_weights{
    {{"strain_energy", &Objective::strain_energy},
     {"uniformity_annulus", &Objective::uniformity_annulus},
     {"uniformity_dual", &Objective::uniformity_dual},
     {"uniformity_l2", &Objective::uniformity_l2}}};

/// Null if the quantity has no weight in the sum.
inline const ObjectiveWeight* objective_weight(std::string_view quantity) {
  const auto found = std::ranges::find(objective_weights, quantity, &ObjectiveWeight::quantity);
  return found == objective_weights.end() ? nullptr : found;
}

}  // namespace wheelwright
