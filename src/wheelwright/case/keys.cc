#include "wheelwright/case/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "wheelwright/base/text.h"
#include "wheelwright/case/number_text.h"

namespace wheelwright {

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_end == End::closed ? value >= low : value > low) &&
         (high_end == End::closed ? value <= high : value < high);
}

std::string Range::text() const {
  return fmt::format("{} {} value {} {}", number_text(low), low_end == End::closed ? "<=" : "<",
                     high_end == End::closed ? "<=" : "<", number_text(high));
}

bool keeps(TextRule rule, const std::string& text) {
  if (rule == TextRule::any) return true;
  const std::filesystem::path path = text;
  return path.is_relative() && without_control_characters(text) == text &&
         std::find(path.begin(), path.end(), "..") == path.end();
}

std::string_view rule_text(TextRule rule) {
  return rule == TextRule::any ? "text" : "a relative path without .. or control characters";
}

}  // namespace wheelwright
