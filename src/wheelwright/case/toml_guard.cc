#include "wheelwright/case/toml_guard.h"

#include <fmt/format.h>

#include <tuple>

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

TextPlace place_of(std::string_view text, std::size_t position) {
  int line = 1, column = 1;
  for (const char c : text.substr(0, position)) {
    column = c == '\n' ? 1 : column + 1;
    line += c == '\n';
  }
  return {line, column};
}

ParserLimitExceeded at(std::string_view text, std::size_t position, std::string problem) {
  const auto [line, column] = place_of(text, position);
  return {line, column, std::move(problem)};
}

/// Whether the string that ends at `end` has its quotes there.
bool is_closed(std::string_view text, std::size_t begin, std::size_t end) {
  const std::string triple(3, text[begin]);
  const std::size_t quotes = text.substr(begin, 3) == triple ? 3 : 1;
  return end >= begin + 2 * quotes && text.substr(end - quotes, quotes) == triple.substr(0, quotes);
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

std::optional<TextPlace> unclosed_string(std::string_view text, int line, int column) {
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '#') {
      i = end_of_line(text, i);
    } else if (text[i] != '"' && text[i] != '\'') {
      ++i;
    } else {
      const std::size_t end = end_of_string(text, i);
      const TextPlace begin = place_of(text, i), behind = place_of(text, std::min(end, text.size()));
      const bool begins_before = std::tie(begin.line, begin.column) < std::tie(line, column);
      if (!begins_before) return {};
      const bool holds_the_place = std::tie(line, column) <= std::tie(behind.line, behind.column);
      if (!is_closed(text, i, end) && (holds_the_place || end >= text.size())) return begin;
      i = end;
    }
  }
  return {};
}

std::optional<std::string> other_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  const auto begins = [&](std::string_view bytes) { return text.starts_with(bytes); };
  if (begins("\xff\xfe\0\0"sv) || begins("\0\0\xfe\xff"sv)) return "UTF-32";
  if (begins("\xff\xfe") || begins("\xfe\xff")) return "UTF-16";
  const bool is_wide = text.size() >= 4 && (text[0] == '\0') != (text[1] == '\0') &&
                       (text[0] == '\0') == (text[2] == '\0') && (text[1] == '\0') == (text[3] == '\0');
  return is_wide ? std::optional<std::string>("UTF-16") : std::nullopt;
}

}  // namespace wheelwright
