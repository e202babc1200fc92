#include "wheelwright/case/points_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace wheelwright {
namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// The character between the numbers of a line.
char separator_of(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::optional<double> number(std::string_view text, bool has_decimal_comma) {
  std::string digits(trimmed(text));
  if (has_decimal_comma) std::ranges::replace(digits, ',', '.');
  double value = 0;
  const char* begin = digits.data() + (digits.starts_with('+') ? 1 : 0);
  const char* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return {};
  return value;
}

std::optional<std::array<double, 2>> point(std::string_view line) {
  const char separator = separator_of(line);
  const auto at = line.find(separator);
  if (at == std::string_view::npos) return {};
  const bool has_decimal_comma = separator == ';' || separator == '\t';
  const auto x = number(line.substr(0, at), has_decimal_comma);
  const auto y = number(line.substr(at + 1), has_decimal_comma);
  if (!x || !y) return {};
  return std::array{*x, *y};
}

bool has_digit(std::string_view line) {
  return std::ranges::any_of(line, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

Expected<std::vector<std::array<double, 2>>, PointsError> parse_points(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<std::array<double, 2>> points;
  bool may_be_words = true;
  for (int n = 1; !text.empty(); ++n) {
    const auto length = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, length));
    text.remove_prefix(std::min(length + 1, text.size()));
    if (line.empty() || line.starts_with('#')) continue;
    const auto of_line = point(line);
    if (of_line)
      points.push_back(*of_line);
    else if (!may_be_words || has_digit(line))
      return PointsError{n, "must be two numbers"};
    may_be_words = false;
  }
  return points;
}

}  // namespace wheelwright
