#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/derived.h"

namespace wheelwright {

// Conflicts of a case under its load cases, which are counted from 0.

std::vector<int> all_load_cases(const Case& c);

/// The load cases that the objective contains.
std::vector<int> weighted_load_cases(const Case& c);

/// The keys of a conflict under one load case: its own replace those of [load] that it changes.
std::vector<std::string> keys_in_load_case(const Case& c, int load_case, std::vector<std::string> keys);

/// Calls check(case, conflicts) for some load cases, each as the only load. Common conflicts are reported
/// once.
template <class Check>
void check_load_cases(const Case& c, const std::vector<int>& load_cases, Conflicts& found, Check check) {
  if (c.load.cases.empty()) {
    check(c, found);
    return;
  }
  for (const int k : load_cases) {
    Conflicts of_case;
    check(with_load_case(c, k), of_case);
    for (Conflict& conflict : of_case) {
      conflict.keys = keys_in_load_case(c, k, conflict.keys);
      const auto is_same = [&](const Conflict& other) {
        return other.keys == conflict.keys && other.problem == conflict.problem;
      };
      if (std::ranges::none_of(found, is_same)) found.push_back(std::move(conflict));
    }
  }
}

}  // namespace wheelwright
