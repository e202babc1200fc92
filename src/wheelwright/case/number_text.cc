#include "wheelwright/case/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace wheelwright {

std::string number_text(double value) {
  constexpr double smallest_with_exponent = 1e6, largest_exact_integer = 1e15;
  const double size = std::abs(value);
  if (size < smallest_with_exponent || size > largest_exact_integer) return fmt::format("{}", value);
  int exponent = 0;
  while (std::fmod(value, 1000) == 0) {
    value /= 1000;
    exponent += 3;
  }
  return exponent > 0 ? fmt::format("{}e{}", value, exponent) : fmt::format("{}", value);
}

}  // namespace wheelwright
