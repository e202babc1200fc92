#pragma once

#include <filesystem>

#include "wheelwright/case/case.h"

namespace wheelwright {

// A run's folder contains copies of the drawings, pictures and the saved shape of its case, so that it can be
// resumed, or computed again, without the originals.

/// The case with its drawings and its saved shape under the names of their copies, e.g.
/// drawings/drawing_1.svg.
Case with_own_drawings(Case c);

/// Writes the copies named in such a case to a folder. Throws OutputError.
void write_drawings(const std::filesystem::path& folder, const Case& c);

}  // namespace wheelwright
