#pragma once

#include <string>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// "azimuth 12.34 deg, radius 270.1 mm" of a point (radius, azimuth[, axial]) of the ring.
template <int dim>
std::string place_text(const Vec<dim>& polar);

/// "12.3 mm^2", or mm^3 when dim = 3, of a measure in SI units.
template <int dim>
std::string measure_text(double measure);

}  // namespace wheelwright
