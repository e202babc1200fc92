#include "wheelwright/cad/outline_fault.h"

#include <cmath>
#include <numbers>

#include "wheelwright/geometry/place.h"

namespace wheelwright {

std::string place_of(const Vec<2>& point) {
  const double azimuth = std::atan2(point[1], point[0]);
  return place_text<2>({norm<2>(point), azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth});
}

}  // namespace wheelwright
