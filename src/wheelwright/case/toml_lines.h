#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

struct SyntaxError {
  int line, column;  ///< from 1
  std::string problem;
};

/// What of a text is TOML.
struct TomlLines {
  toml::table root;  ///< all but the wrong lines; empty if the last error hides what follows it
  std::vector<SyntaxError> errors;  ///< in the order of the file, at most one a line
};

/// Parses a text. A line that is wrong by itself, as by a unit after a number or a second value of a key, is
/// left out and the rest parsed, so that several mistakes are found at once.
TomlLines parse_toml_lines(std::string_view text);

}  // namespace wheelwright
