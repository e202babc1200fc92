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

/// All conflicts of a case.
std::vector<Conflict> conflicts(const Case& c);

/// Whether a modulus [Pa] is smaller than that of any solid wheel; and the question whether MPa were meant.
bool may_be_in_megapascals(double modulus);
std::string question_of_megapascals(double modulus);

}  // namespace wheelwright
