#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// No case file is longer.
inline constexpr std::size_t most_case_bytes = 1 << 20;

/// Where a text goes beyond what the TOML parser can take without exhausting the stack.
struct ParserLimitExceeded {
  int line, column;  ///< from 1
  std::string problem;
};

/// Checks the size of the text and the depth of its dotted keys, before parsing. Text inside strings and
/// comments does not count.
std::optional<ParserLimitExceeded> exceeded_parser_limit(std::string_view text);

}  // namespace wheelwright
