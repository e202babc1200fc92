#include "wheelwright/case/shown_value.h"

#include <fmt/format.h>

namespace wheelwright {

ShownUnit shown_unit(const Quantity& quantity, const Wheel& wheel) {
  return shown_unit(kind(quantity), wheel.dimension, wheel.width);
}

std::string shown_text(double value, const ShownUnit& shown) {
  return fmt::format("{:.6g} {}", value * shown.factor, shown.name);
}

std::string shown_text(const Quantity& quantity, double value, const Wheel& wheel) {
  return shown_text(value, shown_unit(quantity, wheel));
}

}  // namespace wheelwright
