#pragma once

#include <string>
#include <vector>

#include "wheelwright/quantities/analysis/ground_pass.h"

namespace wheelwright {

/// For display: one line per place of the ground with the means over the positions and the range of the force
/// along the ground, and why places could not be computed. `forces`: from the states' forces to those of the
/// whole width.
std::string pass_table(const std::vector<PassPlace>& pass, double forces);

/// One line per place and position, in SI units, forces on the whole width; places that could not be computed
/// are left out.
std::string pass_csv(const std::vector<PassPlace>& pass, double forces);

}  // namespace wheelwright
