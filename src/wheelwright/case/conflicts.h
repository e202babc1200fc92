#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Values that are in range but contradict each other.
struct Conflict {
  std::vector<std::string> keys;  ///< paths of all keys involved, the most likely cause first
  std::string problem;
  std::string remedy;
  std::string other_place = {};  ///< a key whose line is appended to the problem
};
using Conflicts = std::vector<Conflict>;

/// All conflicts of a case.
Conflicts conflicts(const Case& c);

}  // namespace wheelwright
