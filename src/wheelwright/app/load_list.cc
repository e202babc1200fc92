#include "wheelwright/app/load_list.h"

#include <algorithm>

#include "wheelwright/app/number_list.h"

namespace wheelwright {

std::optional<std::vector<double>> parse_loads(const std::string& text) {
  auto loads = parse_number_list(text);
  if (!loads || std::ranges::any_of(*loads, [](double load) { return load <= 0; })) return {};
  std::ranges::sort(*loads);
  loads->erase(std::unique(loads->begin(), loads->end()), loads->end());
  return loads;
}

}  // namespace wheelwright
