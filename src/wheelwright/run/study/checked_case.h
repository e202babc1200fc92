#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/case/case.h"
#include "wheelwright/case/diagnostic.h"

namespace wheelwright {

/// What is found of a case file before a run.
struct CheckedCase {
  std::string file;
  std::optional<Case> value;  ///< present if and only if there are no problems
  std::vector<Diagnostic> problems;
  std::vector<std::string> notes = {};             ///< derived numbers as text; each ends its lines
  std::optional<cad::Clearances> clearances = {};  ///< of the initial shape, if they were measured
  std::vector<std::string> warnings = {};
};

/// For programs: problems with their places, warnings, and derived numbers in SI units, which are null if
/// there are problems.
std::string check_json(const CheckedCase& checked);

}  // namespace wheelwright
