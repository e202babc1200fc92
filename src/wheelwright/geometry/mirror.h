#pragma once

#include <span>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

// Mirror images with respect to the plane of azimuth 0. A cyclic shape that is symmetric with respect to this
// plane is symmetric with respect to the middle plane of each sector too. Therefore cells and nodes of a
// sector are mapped to cells and nodes of the same sector.

/// Whether nodal values are mirror-symmetric up to an absolute tolerance. False if a value is NaN.
template <int dim>
bool is_mirror_symmetric(const Lattice<dim>& lattice, std::span<const double> values, double tolerance);

/// Whether a shape is mirror-symmetric, up to 1e-9 of the resolution of the grid.
template <int dim>
bool is_mirror_symmetric(const LevelSet<dim>& psi);

/// Returns the mean of a level set and its mirror image.
template <int dim>
LevelSet<dim> mirror_symmetric_part(const LevelSet<dim>& psi);

/// Index of the cell that is the mirror image of a cell in the same sector.
template <int dim>
int mirror_image(const PolarGrid<dim>& grid, int cell) {
  auto position = grid.cell_position(cell);
  position[1] = grid.columns() - 1 - position[1];
  return grid.cell_index(position);
}

/// Mirror image of a vector, given by polar or Cartesian components, or of a direction in the unit cell.
template <int dim>
Vec<dim> mirror_image(Vec<dim> v) {
  v[1] = -v[1];
  return v;
}

}  // namespace wheelwright
