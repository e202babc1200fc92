#include "case/diagnostic.h"

#include <fmt/format.h>

namespace wheelwright {

std::string Diagnostic::text() const {
  std::string result = file;
  if (line > 0) result += fmt::format(":{}:{}", line, column);
  result += ": ";
  if (!key.empty()) result += value.empty() ? key + ": " : fmt::format("{} = {}: ", key, value);
  result += problem;
  if (!remedy.empty()) result += "; " + remedy;
  return result;
}

}  // namespace wheelwright
