#include "wheelwright/case/toml_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace wheelwright {

namespace {

constexpr int max_dots_in_key = 16;

/// Position just after the string that starts at `begin`; an unterminated one ends with its line, or the
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

/// The place after some text that starts at `place`. Columns count characters.
TextPlace behind(TextPlace place, std::string_view text) {
  for (const char c : text) {
    const bool begins_character = (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    place = c == '\n' ? TextPlace{place.line + 1, 1} : TextPlace{place.line, place.column + begins_character};
  }
  return place;
}

ParserLimitExceeded at(std::string_view text, std::size_t position, std::string problem) {
  const auto [line, column] = behind({1, 1}, text.substr(0, position));
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
  TextPlace place{1, 1};
  for (std::size_t i = 0, end; i < text.size(); i = end) {
    const bool is_string = text[i] == '"' || text[i] == '\'';
    end = is_string ? end_of_string(text, i) : text[i] == '#' ? end_of_line(text, i) : i + 1;
    end = std::min(end, text.size());
    if (std::tie(place.line, place.column) >= std::tie(line, column)) return {};
    const TextPlace begin = std::exchange(place, behind(place, text.substr(i, end - i)));
    const bool holds_it = std::tie(line, column) <= std::tie(place.line, place.column) || end == text.size();
    if (is_string && holds_it && !is_closed(text, i, end)) return begin;
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
