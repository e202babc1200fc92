#include "wheelwright/geometry/place.h"

#include <fmt/format.h>

#include <numbers>

namespace wheelwright {

template <int dim>
std::string place_text(const Vec<dim>& polar) {
  return fmt::format("azimuth {:.2f} deg, radius {:.1f} mm", polar[1] * 180 / std::numbers::pi,
                     polar[0] * 1e3);
}

template <int dim>
std::string measure_text(double measure) {
  return fmt::format("{:.3g} mm^{}", measure * std::pow(1e3, dim), dim);
}

template std::string place_text<2>(const Vec<2>&);
template std::string place_text<3>(const Vec<3>&);
template std::string measure_text<2>(double);
template std::string measure_text<3>(double);

}  // namespace wheelwright
