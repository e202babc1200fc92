#pragma once

#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The model on a finer grid, for estimates of the discretization error: with twice as many cells along each
/// axis in 2D, and in 3D, where that would cost too much, with 4/3 as many, rounded up. An even number of
/// cells along the axle stays even. Loads, load positions, the number of halvings at the tread and, where
/// tractions are observed in its condensed rows, their thickness stay the same, and layers end on lines of
/// the grid: with twice as many radial cells all that holds. Between fixed lines rows multiply by themselves.
/// The layers of the model must end on lines of its grid.
template <int dim>
RollingModel<dim> on_finer_grid(RollingModel<dim> model);

/// The factor by which the cells of a grid of on_finer_grid() are smaller, where and in the direction in
/// which it is smallest.
template <int dim>
double refinement(const PolarGrid<dim>& grid, const PolarGrid<dim>& finer);

/// The same shape on another grid of its ring, with a level set of the same degree. Exact if the grid divides
/// every cell of the shape's into equal parts.
template <int dim>
LevelSet<dim> on_grid(const LevelSet<dim>& psi, const PolarGrid<dim>& grid);

/// The number of unknowns of the displacement in the full ring if every cell held material.
template <int dim>
double dof_bound(const RollingModel<dim>& model);

}  // namespace wheelwright
