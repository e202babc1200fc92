#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/case_key.h"

namespace wheelwright {

/// Values that are in range but contradict each other.
struct Conflict {
  CaseKeys keys;  ///< all that are involved, the most likely cause first
  std::string problem;
  std::string remedy;
  std::optional<CaseKey> other_place = {};  ///< a key whose line is appended to the problem
};
using Conflicts = std::vector<Conflict>;

/// All conflicts of a case.
Conflicts conflicts(const Case& c);

}  // namespace wheelwright
