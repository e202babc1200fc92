#pragma once

#include <algorithm>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Polar coordinates of the body (m, rad, m) of a point of a unit cell, in a sector.
template <int dim>
Vec<dim> place_in_body(const PolarGrid<dim>& grid, int cell, const Vec<dim>& xi, int sector = 0) {
  Vec<dim> place = grid.polar_point(grid.cell_position(cell), xi);
  place[1] += sector * grid.sector_angle();
  return place;
}

/// Cartesian, in the body frame, of a point of an isoparametric cell of sector 0 [m].
template <int dim>
Vec<dim> cartesian_place(const PolarGrid<dim>& grid, int map_degree, int cell, const Vec<dim>& xi) {
  const auto place = grid.cell_position(cell);
  const CellMap<dim> map(grid, map_degree, place);
  return rotated<dim>(map.position(ShapeFunctions<dim>(map_degree, xi)), place[1] * grid.column_angle());
}

/// A place as three coordinates; the last one is 0 when dim = 2.
template <std::size_t dim>
Vec<3> three_coordinates(const std::array<double, dim>& place) {
  Vec<3> result{};
  std::ranges::copy(place, result.begin());
  return result;
}

}  // namespace wheelwright
