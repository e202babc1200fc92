#pragma once

#include <string>
#include <vector>

#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The numbers derived from a case, one per line.
std::string derived_report(const Case& c);

/// The minimum widths of an outline, one per line.
std::string clearance_report(const cad::Clearances& clearances);

/// Warnings about a case that is valid but doubtful.
std::vector<std::string> warnings(const Case& c);

}  // namespace wheelwright
