#pragma once

#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Values that are each in range but do not go together.
struct Conflict {
  std::vector<std::string> keys;  ///< paths of all keys involved, the one to blame first
  std::string problem;
  std::string remedy;
};

/// All conflicts of a case.
std::vector<Conflict> conflicts(const Case& c);

}  // namespace wheelwright
