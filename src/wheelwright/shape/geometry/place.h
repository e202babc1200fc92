#pragma once

#include <string>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Describes a point (radius, azimuth[, axial]) of the ring, e.g. "azimuth 12.34 deg, radius 270.1 mm".
template <int dim>
std::string place_text(const Vec<dim>& polar);

/// Describes an area (or a volume when dim = 3) given in SI units, e.g. "12.3 mm^2".
template <int dim>
std::string measure_text(double measure);

}  // namespace wheelwright
