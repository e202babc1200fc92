#include "wheelwright/shape/geometry/place.h"

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

template decltype(place_text<2>) place_text<2>;
template decltype(place_text<3>) place_text<3>;
template decltype(measure_text<2>) measure_text<2>;
template decltype(measure_text<3>) measure_text<3>;

}  // namespace wheelwright
