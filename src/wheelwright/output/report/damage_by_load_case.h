#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "wheelwright/quantities/analysis/fatigue_damage.h"

namespace wheelwright {

/// Which load cases, of these names, do the damage at a place, e.g. "damage: 80 % by drive, 20 % by kerb".
std::string damage_text(const FatigueDamage::Worst& worst, const std::vector<std::string>& load_cases);

/// The part of each by its name.
nlohmann::ordered_json damage_json(const FatigueDamage::Worst& worst,
                                   const std::vector<std::string>& load_cases);

}  // namespace wheelwright
