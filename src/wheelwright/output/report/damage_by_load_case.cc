#include "wheelwright/output/report/damage_by_load_case.h"

#include <fmt/format.h>

namespace wheelwright {

std::string damage_text(const FatigueDamage::Worst& worst, const std::vector<std::string>& load_cases) {
  std::string text = "damage:";
  for (std::size_t k = 0; k < load_cases.size(); ++k)
    text += fmt::format("{} {:.3g} % by {}", k > 0 ? "," : "", 100 * worst.by_case[k], load_cases[k]);
  return text;
}

nlohmann::ordered_json damage_json(const FatigueDamage::Worst& worst,
                                   const std::vector<std::string>& load_cases) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < load_cases.size(); ++k) json[load_cases[k]] = worst.by_case[k];
  return json;
}

}  // namespace wheelwright
