#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// kappa_m = div(grad psi / |grad psi|) [1/m] at a point of a cell: the sum of the principal curvatures of
/// the level set through it, negative where the material is outside of a circle. `map_degree` is the degree
/// of the cell's geometry.
template <int dim>
double mean_curvature(const LevelSet<dim>& psi, int map_degree, int cell, const Vec<dim>& xi);

}  // namespace wheelwright
