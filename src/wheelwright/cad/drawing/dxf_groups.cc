#include "wheelwright/cad/drawing/dxf_groups.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace wheelwright {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view spaces = " \t\r";
  const std::size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return {};  // "nan" and "inf"
  return value;
}

/// Takes a line off the beginning of a text.
std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return trimmed(line);
}

}  // namespace

double DxfGroup::number() const {
  return parsed<double>(value).value_or(std::numeric_limits<double>::quiet_NaN());
}

bool DxfGroup::is_malformed() const {
  const bool is_number = (code >= 10 && code < 60) || (code >= 210 && code < 240);
  return is_number && !parsed<double>(value);
}

int DxfGroup::integer() const { return parsed<int>(value).value_or(0); }

bool DxfRecord::has(int code) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return true;
  return false;
}

double DxfRecord::number(int code, double absent) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return group.number();
  return absent;
}

int DxfRecord::integer(int code, int absent) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return group.integer();
  return absent;
}

std::string_view DxfRecord::text(int code) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return group.value;
  return {};
}

Point DxfRecord::point(int x_code) const { return {number(x_code, 0), number(x_code + 10, 0)}; }

std::vector<double> DxfRecord::numbers(int code) const {
  std::vector<double> result;
  for (const DxfGroup& group : groups)
    if (group.code == code) result.push_back(group.number());
  return result;
}

std::vector<DxfRecord> dxf_records(std::string_view bytes, std::vector<DrawingProblem>& problems) {
  std::vector<DxfRecord> records;
  if (bytes.starts_with("AutoCAD Binary DXF")) {
    problems.push_back({1, "this is a binary DXF", "save the drawing as ASCII DXF"});
    return records;
  }
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  int line = 1;
  bool ended = false;
  while (!bytes.empty() && !ended) {
    const std::string_view code_text = next_line(bytes);
    if (code_text.empty() && trimmed(bytes).empty()) break;
    const auto code = parsed<int>(code_text);
    if (!code) {
      problems.push_back({line, "a group code is expected, a whole number: this is no DXF, or it is damaged",
                          "save the drawing again as ASCII DXF"});
      return records;
    }
    const DxfGroup group{line, *code, next_line(bytes)};
    line += 2;
    if (group.code == 0)
      records.push_back({group.line, group.value, {}});
    else if (!records.empty())
      records.back().groups.push_back(group);
    ended = group.code == 0 && group.value == "EOF";
  }
  if (!ended)
    problems.push_back(
        {line, "the file ends without EOF: it is cut off, or no DXF", "save the drawing again"});
  return records;
}

}  // namespace wheelwright
