#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"
#include "wheelwright/quantities/analysis/deformation_size.h"

namespace wheelwright {

/// The case with few load positions, on a coarser grid if its own is large, such that it is solved in about a
/// tenth of a second in 2D.
Case on_predicting_grid(Case c);

/// How far the initial shape of a case deforms under one load.
struct PredictedDeformation {
  std::string load_case;  ///< its name; empty if the case has one load
  std::string grid;       ///< e.g. "grid 14 x 192"
  Expected<DeformationSize> size;
};

/// Solves the initial shape of a case under every load at a few positions, on a coarser grid if the case's
/// own is large. In 3D the wheel's middle plane is solved in plane strain, and only if the shape is the same
/// over the width. Loads that no grid of that size can solve are left out.
std::vector<PredictedDeformation> predicted_deformations(const Case& c, const Interrupt& interrupt = {});

/// Their travels and strains, a line for each.
std::string prediction_note(std::span<const PredictedDeformation> predicted);

/// Warns of the first one that exceeds what deformation_warning() allows or has no solution; empty if none.
std::optional<std::string> prediction_warning(std::span<const PredictedDeformation> predicted);

/// The numbers of that solution, for the only load of a 2D case.
Expected<DeformationSize> predicted_size(const Case& c);

}  // namespace wheelwright
