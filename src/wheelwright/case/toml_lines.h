#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

struct SyntaxError {
  int line, column;  ///< from 1
  std::string problem;
  std::string remedy = {};  ///< empty: that of any syntax error
};

/// The parts of a text that are valid TOML, and the errors in the rest.
struct TomlLines {
  toml::table root;  ///< without the faulty lines; empty if the last error hides the rest of the text
  std::vector<SyntaxError> errors;  ///< in the order of the file, at most one per line
};

/// Parses a text. A line with its own error, such as a unit after a number or a duplicate key, is skipped and
/// the rest is parsed, so that several mistakes are found at once.
TomlLines parse_toml_lines(std::string_view text);

}  // namespace wheelwright
