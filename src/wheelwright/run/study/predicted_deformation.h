#pragma once

#include <optional>
#include <string>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"
#include "wheelwright/quantities/analysis/deformation_size.h"

namespace wheelwright {

/// The case with few load positions, on a coarser grid if its own is large, such that it is solved in about a
/// tenth of a second in 2D.
Case on_predicting_grid(Case c);

/// Warns of deformations beyond linear elasticity before a run: solves the initial shape of a case at a few
/// load positions, on a coarser grid if the case's own is large. In 3D the wheel's middle plane is solved in
/// plane strain, and only if the shape is the same over the width. Empty if nothing exceeds what
/// deformation_warning() allows, or if no grid of that size can be solved.
std::optional<std::string> predicted_deformation(const Case& c, const Interrupt& interrupt = {});

/// The numbers of that solution, for the only load of a 2D case.
Expected<DeformationSize> predicted_size(const Case& c);

}  // namespace wheelwright
