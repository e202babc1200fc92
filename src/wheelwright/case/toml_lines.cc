#include "wheelwright/case/toml_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "wheelwright/base/text.h"
#include "wheelwright/case/toml_guard.h"

namespace wheelwright {

namespace {

constexpr std::size_t most_wrong_lines = 20;

/// Parses into `root`, or leaves it unchanged and returns the first error.
std::optional<SyntaxError> parse(std::string_view text, toml::table& root) {
  try {
    root = toml::parse(text);
    return {};
  } catch (const toml::parse_error& error) {
    const auto begin = error.source().begin;
    return SyntaxError{static_cast<int>(begin.line), static_cast<int>(begin.column),
                       std::string(error.description())};
  }
}

/// The characters of a line, without the line feed.
struct LineSpan {
  std::size_t begin, length;
};

LineSpan find_line(std::string_view text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  return {begin, std::min(text.find('\n', begin), text.size()) - begin};
}

bool begins_table(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == '[';
}

bool may_continue_on_next_line(std::string_view line) {
  return line.find_first_of("[{") != std::string_view::npos ||
         line.find("\"\"\"") != std::string_view::npos || line.find("'''") != std::string_view::npos;
}

/// Removes the line of an error from the text; false if the error may belong to other lines too. A table
/// keeps a header, so that its keys do not end up in the table before it.
bool take_out(std::string& text, int line) {
  const LineSpan span = find_line(text, line);
  const std::string_view wrong = std::string_view(text).substr(span.begin, span.length);
  const bool table = begins_table(wrong);
  toml::table before;
  if ((!table && may_continue_on_next_line(wrong)) ||
      parse(std::string_view(text).substr(0, span.begin), before))
    return false;
  text.replace(span.begin, span.length, table ? fmt::format("[\"table of line {}\"]", line) : "");
  return true;
}

/// Replaces invalid UTF-8; returns its places, one per line.
std::vector<SyntaxError> replace_wrong_bytes(std::string& text) {
  std::vector<SyntaxError> errors;
  int line = 1, column = 1;
  for (std::size_t i = 0; i < text.size(); ++column) {
    const std::size_t length = utf8_length(std::string_view(text).substr(i));
    if (length == 0) {
      text[i] = '?';
      if (errors.empty() || errors.back().line < line)
        errors.push_back({line, column, "not UTF-8", "save the file as UTF-8"});
    } else if (text[i] == '\n') {
      ++line;
      column = 0;
    }
    i += std::max<std::size_t>(length, 1);
  }
  return errors;
}

/// If a quote is missing, the parser reports the end of the line, or of the whole text: replaces that by the
/// start of the string.
void blame_unclosed_string(std::string_view text, SyntaxError& error) {
  const auto begin = unclosed_string(text, error.line, error.column);
  if (begin)
    error = {begin->line, begin->column, "the string that starts here is not terminated",
             "close it with the same quotes"};
}

/// Adds the errors of other lines than those of `errors`.
void add_other_lines(std::vector<SyntaxError>& errors, const std::vector<SyntaxError>& others) {
  const std::size_t n = errors.size();
  for (const SyntaxError& other : others)
    if (std::none_of(errors.begin(), errors.begin() + n, [&](const auto& e) { return e.line == other.line; }))
      errors.push_back(other);
  std::stable_sort(errors.begin(), errors.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
}

}  // namespace

TomlLines parse_toml_lines(std::string_view text) {
  TomlLines result;
  std::string rest(text);
  result.errors = replace_wrong_bytes(rest);
  std::vector<SyntaxError> wrong_lines;
  while (auto error = parse(rest, result.root)) {
    const int line_of_error = error->line;
    blame_unclosed_string(rest, *error);
    const bool comes_later = wrong_lines.empty() || error->line > wrong_lines.back().line;
    if (comes_later) wrong_lines.push_back(*error);
    if (!comes_later || wrong_lines.size() == most_wrong_lines || !take_out(rest, line_of_error)) break;
  }
  add_other_lines(result.errors, wrong_lines);
  return result;
}

}  // namespace wheelwright
