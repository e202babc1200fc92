#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/conflicts.h"

namespace wheelwright {

/// A case with one of its loads as the only one.
struct SingleLoad {
  Case c;                           ///< its section [load] has the load
  std::optional<int> load_case;     ///< from which it is, counted from 0; empty: the section [load]
  std::optional<CaseLoad> changes;  ///< of that load case

  /// The key that sets this member of the load: in its [[load.case]] if that changes it, else in [load].
  template <class Value>
  CaseKey key(Value Load::*member) const {
    return where_set(key_of(member));
  }

 private:
  CaseKey where_set(CaseKey key) const;
};

/// The loads of a case: of these load cases, counted from 0, or the only one.
std::vector<SingleLoad> single_loads(const Case& c, const std::vector<int>& load_cases);

/// All of them.
std::vector<SingleLoad> single_loads(const Case& c);

/// The load cases that the objective contains.
std::vector<int> weighted_load_cases(const Case& c);

/// How the objective is made of load cases, in words: empty for one load, or if the objective depends on the
/// shape alone.
std::string sum_over_load_cases(const Case& c);

/// Calls check(load, conflicts) for each load. Common conflicts are reported once.
template <class Check>
void check_loads(const std::vector<SingleLoad>& loads, Conflicts& found, Check check) {
  for (const SingleLoad& load : loads) {
    Conflicts of_load;
    check(load, of_load);
    for (Conflict& conflict : of_load) {
      const auto is_same = [&](const Conflict& other) {
        return other.keys == conflict.keys && other.problem == conflict.problem;
      };
      if (std::ranges::none_of(found, is_same)) found.push_back(std::move(conflict));
    }
  }
}

}  // namespace wheelwright
