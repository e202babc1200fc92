#include "wheelwright/case/toml_guard.h"

#include <fmt/format.h>

namespace wheelwright {

namespace {

constexpr int max_dots_in_key = 16;

/// Position just after the string that begins at `begin`; an unterminated one ends with its line, or the
/// text.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string triple(3, quote);
  const bool multiline = text.substr(begin, 3) == triple;
  std::size_t i = begin + (multiline ? 3 : 1);
  while (i < text.size()) {
    if (text[i] == '\\' && quote == '"') {
      i += 2;
    } else if (multiline && text.substr(i, 3) == triple) {
      return i + 3;
    } else if (!multiline && text[i] == quote) {
      return i + 1;
    } else if (!multiline && text[i] == '\n') {
      return i;
    } else {
      ++i;
    }
  }
  return text.size();
}

std::size_t end_of_line(std::string_view text, std::size_t begin) {
  return std::min(text.find('\n', begin), text.size());
}

ParserLimitExceeded at(std::string_view text, std::size_t position, std::string problem) {
  int line = 1, column = 1;
  for (const char c : text.substr(0, position)) {
    column = c == '\n' ? 1 : column + 1;
    line += c == '\n';
  }
  return {line, column, std::move(problem)};
}

}  // namespace

std::optional<ParserLimitExceeded> exceeded_parser_limit(std::string_view text) {
  if (text.size() > most_case_bytes)
    return ParserLimitExceeded{1, 1, fmt::format("the file is longer than {} bytes", most_case_bytes)};
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
    } else if (c == '#') {
      i = end_of_line(text, i);
    } else {
      const bool key_ends = std::string_view("\n=,[]{}").find(c) != std::string_view::npos;
      dots = key_ends ? 0 : dots + (c == '.');
      if (dots > max_dots_in_key)
        return at(text, i, fmt::format("a key with more than {} dots", max_dots_in_key));
      ++i;
    }
  }
  return {};
}

}  // namespace wheelwright
