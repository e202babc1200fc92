#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/diagnostic.h"

namespace wheelwright {

// Files that a case names, such as drawings.

/// A problem of a file that a case names.
struct FileProblem {
  Diagnostic::Kind kind;
  std::string key;   ///< path of the key that it belongs to, e.g. "shape.file[1].unit"
  std::string file;  ///< in which it stands; empty: the case's own
  int line;          ///< of that file; 0 if it has none
  std::string problem;
  std::string remedy;
};

/// The bytes of a file that the key names; nothing, after a problem, if it cannot be read or has more than
/// `most_bytes`.
std::optional<std::string> read_named_file(const std::filesystem::path& file, const std::string& key,
                                           std::size_t most_bytes, std::vector<FileProblem>& problems);

/// Sets the checksum of the file of a table, such as "shape.file[1]", or compares it with the one that is
/// given.
void check_checksum(std::string& stated, const std::string& bytes, const std::string& table,
                    std::vector<FileProblem>& problems);

}  // namespace wheelwright
