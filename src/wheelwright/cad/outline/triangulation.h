#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright::cad {

using Polygon = std::vector<Vec<2>>;  ///< closed: the last corner is connected to the first

/// The points where polygons cross or touch themselves or each other. Decided exactly for the given corners.
std::vector<Vec<2>> crossings(std::span<const Polygon> polygons);

struct Triangulation {
  std::vector<Vec<2>> points;                 ///< the corners of all polygons, in their order
  std::vector<std::array<int, 3>> triangles;  ///< indices of points, counter-clockwise
};

/// The region that an odd number of polygons encloses, in triangles whose corners are those of the polygons.
/// The polygons must not cross or touch.
Triangulation triangulated(std::span<const Polygon> polygons);

}  // namespace wheelwright::cad
