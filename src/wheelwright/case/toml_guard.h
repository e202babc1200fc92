#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// Maximum length of a case file.
inline constexpr std::size_t most_case_bytes = 1 << 20;

/// The place where a text exceeds what the TOML parser can parse without exhausting the stack.
struct ParserLimitExceeded {
  int line, column;  ///< from 1
  std::string problem;
};

/// Checks the size of the text and the depth of its dotted keys, before parsing. Text inside strings and
/// comments is ignored.
std::optional<ParserLimitExceeded> exceeded_parser_limit(std::string_view text);

struct TextPlace {
  int line, column;  ///< from 1
};

/// The start of the string that is open at this place of a text and is not terminated: on its line or,
/// between triple quotes, in the text.
std::optional<TextPlace> unclosed_string(std::string_view text, int line, int column);

/// The encoding of a file that is not UTF-8 but another Unicode encoding, e.g. "UTF-16".
std::optional<std::string> other_encoding(std::string_view text);

}  // namespace wheelwright
