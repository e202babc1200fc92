#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/named_file.h"

namespace wheelwright {

/// The length of a unit [m]; nothing for the unit of the file.
std::optional<double> metres(DrawingUnit unit);

/// Reads the drawings and pictures of a case into it, from paths relative to `folder`, and sets their
/// checksums. Skips the given shapes, e.g. "shape.file[1]".
std::vector<FileProblem> load_drawings(Case& c, const std::filesystem::path& folder,
                                       const std::function<bool(const std::string&)>& may_be_read);

}  // namespace wheelwright
