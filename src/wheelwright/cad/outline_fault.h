#pragma once

#include <string>

#include "wheelwright/cad/outline.h"

namespace wheelwright::cad {

/// Why an outline cannot be created or must not be used.
struct OutlineFault {
  std::string what;  ///< one line, with the place
};

/// A Cartesian point as text, e.g. "azimuth 12.34 deg, radius 270.1 mm".
std::string place_of(const Vec<2>& point);

}  // namespace wheelwright::cad
