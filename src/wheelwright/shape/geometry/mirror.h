#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The plane of azimuth 0, or, when dim = 3, the middle plane of the width. A cyclic shape that is symmetric
/// with respect to the plane of azimuth 0 is symmetric with respect to the middle plane of each sector too.
/// Therefore both planes map cells and nodes of a sector to cells and nodes of the same sector. In 2D
/// everything is symmetric with respect to the middle plane.
enum class MirrorPlane { azimuth, width };

/// Whether nodal values are mirror-symmetric up to an absolute tolerance. False if a value is NaN.
template <int dim>
bool is_mirror_symmetric(const Lattice<dim>& lattice, std::span<const double> values, double tolerance,
                         MirrorPlane plane = MirrorPlane::azimuth);

/// Whether a shape is mirror-symmetric, up to 1e-9 of the resolution of the grid.
template <int dim>
bool is_mirror_symmetric(const LevelSet<dim>& psi, MirrorPlane plane = MirrorPlane::azimuth);

/// The planes with respect to which a shape is symmetric.
template <int dim>
std::vector<MirrorPlane> symmetries(const LevelSet<dim>& psi);

/// Returns the mean of a level set and its mirror image.
template <int dim>
LevelSet<dim> mirror_symmetric_part(const LevelSet<dim>& psi, MirrorPlane plane = MirrorPlane::azimuth);

/// The shape with the mirror symmetries of another one, to the last bit: a stage keeps symmetry only up to
/// rounding.
template <int dim>
LevelSet<dim> with_symmetries_of(const LevelSet<dim>& other, LevelSet<dim> psi);

/// Index of the cell that is the mirror image of a cell in the same sector.
template <int dim>
int mirror_image(const PolarGrid<dim>& grid, int cell, MirrorPlane plane = MirrorPlane::azimuth) {
  auto position = grid.cell_position(cell);
  if (plane == MirrorPlane::azimuth)
    position[1] = grid.columns() - 1 - position[1];
  else if constexpr (dim == 3)
    position[2] = grid.cells[2] - 1 - position[2];
  return grid.cell_index(position);
}

/// Mirror image of a vector, given by polar or Cartesian components, or of a direction in the unit cell.
template <int dim>
Vec<dim> mirror_image(Vec<dim> v) {
  v[1] = -v[1];
  return v;
}

}  // namespace wheelwright
