#include "wheelwright/case/load_case_conflicts.h"

#include <fmt/format.h>

#include <numeric>
#include <string_view>

namespace wheelwright {

namespace {

/// Whether a load case replaces the key of that name in [load].
bool changes(const CaseLoad& load, std::string_view name) {
  if (name == "mass" || name == "force") return load.force.has_value();
  if (name == "travel") return load.travel.has_value();
  if (name == "horizontal_force") return load.horizontal_force.has_value();
  if (name == "torque") return load.torque.has_value();
  if (name == "body_force") return load.body_force.has_value();
  if (name == "hole_pressure") return load.hole_pressure.has_value();
  return name == "speed" && load.speed.has_value();
}

}  // namespace

std::vector<std::string> keys_in_load_case(const Case& c, int load_case, std::vector<std::string> keys) {
  constexpr std::string_view section = "load.";
  for (std::string& key : keys)
    if (key.starts_with(section) && changes(c.load.cases[load_case], key.substr(section.size())))
      key = fmt::format("load.case[{}].{}", load_case + 1, key.substr(section.size()));
  return keys;
}

std::vector<int> all_load_cases(const Case& c) {
  std::vector<int> all(c.load.cases.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<int> weighted_load_cases(const Case& c) {
  std::vector<int> result = all_load_cases(c);
  std::erase_if(result, [&](int k) { return c.load.cases[k].weight == 0; });
  return result;
}

}  // namespace wheelwright
