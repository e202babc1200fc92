#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/diagnostic.h"

namespace wheelwright {

// Files named in a case, such as drawings.

/// A problem with a file named in a case.
struct FileProblem {
  Diagnostic::Kind kind;
  std::string key;   ///< path of its key, e.g. "shape.file[1].unit"
  std::string file;  ///< that contains the problem; empty: the case file
  int line;          ///< of that file; 0 if unknown
  std::string problem;
  std::string remedy;
};

/// The bytes of the file named by the key; nothing, after adding a problem, if it cannot be read or has more
/// than `most_bytes`.
std::optional<std::string> read_named_file(const std::filesystem::path& file, const std::string& key,
                                           std::size_t most_bytes, std::vector<FileProblem>& problems);

/// Sets the checksum of a file, or compares it with the one that its key, e.g. "shape.file[1].checksum",
/// gives.
void check_checksum(std::string& stated, const std::string& bytes, const std::string& key,
                    std::vector<FileProblem>& problems);

}  // namespace wheelwright
