#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/named_file.h"

namespace wheelwright {

/// The file in a run's folder with its last saved shape, a level set (files/level_set_file.h).
inline constexpr std::string_view saved_shape_file = "shape.levelset";

/// Reads the saved shape from which a case starts, if any, from a path relative to `folder`, and sets its
/// checksum.
std::vector<FileProblem> load_saved_shape(Case& c, const std::filesystem::path& folder);

}  // namespace wheelwright
