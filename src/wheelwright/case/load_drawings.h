#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/diagnostic.h"

namespace wheelwright {

/// A problem of a file that a case names.
struct FileProblem {
  Diagnostic::Kind kind;
  std::string key;   ///< path of the key that it belongs to, e.g. "shape.file[1].unit"
  std::string file;  ///< in which it stands; empty: the case's own
  int line;          ///< of that file; 0 if it has none
  std::string problem;
  std::string remedy;
};

/// Reads the drawings and pictures of a case into it, from paths relative to `folder`, and sets their
/// checksums. Leaves out the shapes, such as "shape.file[1]", that must not be read.
std::vector<FileProblem> load_drawings(Case& c, const std::filesystem::path& folder,
                                       const std::function<bool(const std::string&)>& may_be_read);

}  // namespace wheelwright
