#pragma once

#include <filesystem>
#include <string>

#include "wheelwright/rolling/rolling_problem.h"

namespace wheelwright {

/// The load position with the largest strain energy.
int worst_position(const RollingSolution<2>& solution);

/// Draws a solved shape in its worst position: PREFIXstress.svg, PREFIXstress_contact.svg about the contact,
/// PREFIXdisplacement.svg (towards the ground) and PREFIXmesh.svg (the cut grid). Displacements of the
/// outline are magnified. Throws OutputError.
void write_wheel_pictures(const std::filesystem::path& folder, const std::string& prefix,
                          const std::string& title, const RollingProblem<2>& problem,
                          const RollingSolution<2>& solution, const LevelSet<2>& shape);

}  // namespace wheelwright
