#include "wheelwright/case/keys.h"

#include <algorithm>
#include <filesystem>

#include "wheelwright/base/text.h"

namespace wheelwright {

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
