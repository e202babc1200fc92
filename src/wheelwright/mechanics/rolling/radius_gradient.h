#pragma once

#include "wheelwright/mechanics/rolling/shape_gradient.h"

namespace wheelwright {

/// The derivatives of several functions with respect to the radii of the model's design lines,
/// [function][line], summed over all positions and sectors. With the nodal unknowns and the shape in the unit
/// cells held, only the core's matrix, its loads and the integrals over it depend on a radius:
///   dJ/dr = energy u.(dK/dr - dG/dr) u / 2 + p.(dK/dr) u - p.df/dr + dM/dr
/// with the ghost penalty G, which is part of K. They are differences_by_radius() of the discrete forms.
/// `displacement` and `adjoints` are those of all unknowns of the core.
template <int dim>
std::vector<std::vector<double>> radius_gradients(const RollingProblem<dim>& problem,
                                                  const RollingSolution<dim>& solution,
                                                  const SectorFields& displacement,
                                                  std::span<const FunctionalDerivative<dim>> functions,
                                                  std::span<const Adjoint> adjoints);

/// Adjoints of functions, and the gradients that follow from them, without what functions owe to growth.
struct AdjointGradients {
  std::vector<Adjoint> adjoints;
  ShapeGradients gradients;
};

/// shape_gradients() and, if the model has design lines, radius_gradients(). Fails as solve_adjoints() does.
template <int dim>
Expected<AdjointGradients> adjoint_gradients(const RollingProblem<dim>& problem,
                                             const RollingSolution<dim>& solution,
                                             std::span<const FunctionalDerivative<dim>> functions);

}  // namespace wheelwright
