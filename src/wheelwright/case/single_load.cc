#include "wheelwright/case/single_load.h"

#include <algorithm>
#include <numeric>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/key_value.h"

namespace wheelwright {

CaseKey SingleLoad::where_set(CaseKey key) const {
  if (!load_case) return key;
  const auto changes_it = [&](std::string_view name) {
    const Key<CaseLoad>* of_case = find_key(load_case_sections().keys, name);
    return of_case && value(*of_case, *changes);
  };
  if (std::ranges::any_of(key.names, changes_it)) key.table = table_of<CaseLoad>(*load_case).table;
  return key;
}

std::vector<SingleLoad> single_loads(const Case& c, const std::vector<int>& load_cases) {
  if (c.load.cases.empty()) return {{c, {}, {}}};
  std::vector<SingleLoad> loads;
  for (const int k : load_cases) loads.push_back({with_load_case(c, k), k, c.load.cases[k]});
  return loads;
}

std::vector<SingleLoad> single_loads(const Case& c) {
  std::vector<int> all(c.load.cases.size());
  std::iota(all.begin(), all.end(), 0);
  return single_loads(c, all);
}

std::vector<int> weighted_load_cases(const Case& c) {
  std::vector<int> result;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    if (c.load.cases[k].weight > 0) result.push_back(static_cast<int>(k));
  return result;
}

std::string sum_over_load_cases(const Case& c) {
  if (c.load.cases.empty() || c.objective.minimize->of == Positions::none) return "";
  return "weighted sum over the load cases";
}

}  // namespace wheelwright
