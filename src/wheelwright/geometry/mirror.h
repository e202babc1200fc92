#pragma once

#include <span>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

// Mirror images in the plane of azimuth 0. A shape with sectors that is its own mirror image there is so in
// every sector's middle plane too: a sector's cells and nodes have theirs in the same sector.

/// Whether values at the lattice's nodes are their own mirror image. False if one is NaN.
template <int dim>
bool is_mirror_symmetric(const Lattice<dim>& lattice, std::span<const double> values, double tolerance);

/// Whether a shape is its own mirror image, up to 1e-9 of a cell.
template <int dim>
bool is_mirror_symmetric(const LevelSet<dim>& psi);

/// The mean of a level set and its mirror image.
template <int dim>
LevelSet<dim> mirror_symmetric_part(const LevelSet<dim>& psi);

/// The number of the cell where a cell of the sector's grid has its image.
template <int dim>
int mirror_image(const PolarGrid<dim>& grid, int cell) {
  auto position = grid.cell_position(cell);
  position[1] = grid.columns() - 1 - position[1];
  return grid.cell_index(position);
}

/// The image of a vector, given by polar or Cartesian components, or of a direction in the unit cell.
template <int dim>
Vec<dim> mirror_image(Vec<dim> v) {
  v[1] = -v[1];
  return v;
}

}  // namespace wheelwright
