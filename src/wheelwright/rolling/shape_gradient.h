#pragma once

#include "wheelwright/rolling/adjoint.h"

namespace wheelwright {

/// The points at which a solution's shape gradients are given: those of the cut cells' quadrature. When
/// positions stand for their mirror images, the points of a cell are the images of those of its image.
template <int dim>
std::vector<SurfacePoint<dim>> boundary_points(const RollingProblem<dim>& problem,
                                               const RollingSolution<dim>& solution);

/// The densities G of the shape derivatives (42) of several functions at those points, summed over all
/// positions and sectors: M(u) + sigma(u):eps(p) - f.p and, under a pressure p_0 on the moving boundary, +
/// p_0 div p. `adjoints` are those of the functions.
template <int dim>
std::vector<std::vector<double>> shape_gradients(const RollingProblem<dim>& problem,
                                                 const RollingSolution<dim>& solution,
                                                 std::span<const FunctionalDerivative<dim>> functions,
                                                 std::span<const Adjoint> adjoints);

}  // namespace wheelwright
