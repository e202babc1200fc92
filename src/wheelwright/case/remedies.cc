#include "wheelwright/case/remedies.h"

#include <fmt/format.h>

#include <cmath>

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

std::vector<std::string> with_ring_shape(std::vector<std::string> keys) {
  for (const char* key : {"wheel.inner_radius", "wheel.outer_radius", "optimizer.rim_band",
                          "optimizer.tread_band", "grid.radial_cells", "objective.annulus"})
    keys.push_back(key);
  return keys;
}
}  // namespace wheelwright
