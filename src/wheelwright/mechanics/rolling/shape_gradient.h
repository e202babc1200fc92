#pragma once

#include "wheelwright/mechanics/rolling/adjoint.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The points at which a solution's shape gradients are given: those of the cut cells' quadrature. When
/// positions stand for their mirror images, the points of a cell are the images of those of its image.
template <int dim>
std::vector<SurfacePoint<dim>> boundary_points(const RollingProblem<dim>& problem,
                                               const RollingSolution<dim>& solution);

/// Those of the edges in which the moving boundary meets side faces, when dim = 3: those of the quadrature of
/// the cut cells' faces. Their weight is a length.
template <int dim>
std::vector<SurfacePoint<dim>> edge_points(const RollingProblem<dim>& problem,
                                           const RollingSolution<dim>& solution);

/// The densities G of the shape derivatives (42) of several functions at those points, summed over all
/// positions and sectors: M(u) + sigma(u):eps(p) - f.p and, under a pressure p_0 on the moving boundary, +
/// p_0 div p; and those of the edges, -p_0 (p.e) / sqrt(1 - (n.e)^2) with the normal e of the side face.
/// `adjoints` are those of the functions.
template <int dim>
ShapeGradients shape_gradients(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                               std::span<const FunctionalDerivative<dim>> functions,
                               std::span<const Adjoint> adjoints);

}  // namespace wheelwright
