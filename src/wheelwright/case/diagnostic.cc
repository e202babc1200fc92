#include "wheelwright/case/diagnostic.h"

#include <fmt/format.h>

#include "wheelwright/base/text.h"

namespace wheelwright {

std::string Diagnostic::text() const {
  std::string result = without_control_characters(file);
  if (line > 0) result += fmt::format(":{}", line);
  if (line > 0 && column > 0) result += fmt::format(":{}", column);
  result += ": ";
  if (!key.empty()) result += value.empty() ? key + ": " : fmt::format("{} = {}: ", key, value);
  result += problem;
  if (!remedy.empty()) result += "; " + remedy;
  return result;
}

}  // namespace wheelwright
