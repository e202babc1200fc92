#pragma once

#include <filesystem>

#include "wheelwright/case/case.h"

namespace wheelwright {

// A run's folder holds copies of the drawings, pictures and the saved shape that its case names, so that it
// can be resumed, or computed again, whatever becomes of the originals.

/// The case with its drawings and its saved shape under the names of their copies, e.g.
/// drawings/drawing_1.svg.
Case with_own_drawings(Case c);

/// Writes the copies that such a case names into a folder. Throws OutputError.
void write_drawings(const std::filesystem::path& folder, const Case& c);

}  // namespace wheelwright
