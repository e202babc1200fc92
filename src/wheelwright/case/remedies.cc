#include "wheelwright/case/remedies.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "wheelwright/case/number_text.h"

namespace wheelwright {

double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / unit) * unit;
}

std::string if_in_millimetres(double length, double other) {
  if (length <= 3 * other || length > 5000 * other) return "";
  return fmt::format("; lengths are in metres: if {} is in mm, write {}", number_text(length),
                     number_text(length / 1000));
}

CaseKeys with_ring_shape(CaseKeys keys) {
  for (CaseKey key :
       {key_of(&Wheel::inner_radius), key_of(&Wheel::outer_radius), key_of(&Optimizer::rim_band),
        key_of(&Optimizer::tread_band), key_of(&Grid::radial_cells), key_of(&Objective::annulus)})
    keys.push_back(std::move(key));
  return keys;
}
}  // namespace wheelwright
