#include "wheelwright/output/report/remark.h"

#include <fmt/format.h>

namespace wheelwright {
namespace {

/// The lines, indented.
std::string indented(const std::string& lines) {
  std::string result = "    ";
  for (const char c : lines) result += c == '\n' ? "\n    " : std::string(1, c);
  return result;
}

}  // namespace

std::string text(const Remark& remark) {
  return remark.constraint.empty()
             ? remark.text
             : fmt::format("{} To bound it, add to the case:\n{}", remark.text, remark.constraint);
}

std::string remarks_text(const std::vector<Remark>& remarks) {
  std::string result;
  for (const Remark& remark : remarks) {
    result += remark.text;
    if (!remark.constraint.empty())
      result += " To bound it, add to the case:\n" + indented(remark.constraint);
    result += '\n';
  }
  return result;
}

}  // namespace wheelwright
