#include "wheelwright/case/range.h"

#include <fmt/format.h>

#include <cmath>

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

std::string Range::advice_at_open_end(double value) const {
  constexpr double just_below = 0.999;
  if (value != high || high_end == End::closed) return "";
  return fmt::format("; use for example {}", number_text(just_below * high));
}

}  // namespace wheelwright
