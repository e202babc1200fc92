#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/clearance.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The numbers that follow from a case, one a line.
std::string derived_report(const Case& c);

/// The least widths that an outline has, one a line.
std::string clearance_report(const cad::Clearances& clearances);

/// What is allowed but doubtful about a case.
std::vector<std::string> warnings(const Case& c);

}  // namespace wheelwright
