#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/named_file.h"

namespace wheelwright {

/// Reads the drawings and pictures of a case into it, from paths relative to `folder`, and sets their
/// checksums. Leaves out the shapes, such as "shape.file[1]", that must not be read.
std::vector<FileProblem> load_drawings(Case& c, const std::filesystem::path& folder,
                                       const std::function<bool(const std::string&)>& may_be_read);

}  // namespace wheelwright
