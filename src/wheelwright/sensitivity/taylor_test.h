#pragma once

#include <functional>
#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/sensitivity/evaluation.h"

namespace wheelwright {

/// d/dt J(psi + t direction) at t = 0 from the shape gradient: the boundary moves with normal velocity
/// -direction / |grad psi|. `direction` has one value a node of psi's lattice [m]; `map_degree` is the degree
/// of the cells' geometry in the evaluation, the displacement's.
template <int dim>
double directional_derivative(const Evaluation<dim>& evaluation, const LevelSet<dim>& psi,
                              std::span<const double> direction, int map_degree);

/// How well the derivative predicts the objective: |J(t) - J(0) - t J'(0)| for t = step, step/2, ...
struct TaylorTest {
  double objective, derivative;
  std::vector<double> steps;
  std::vector<double> remainders;
  std::vector<double> orders;  ///< log2 of successive remainders' ratios: 2 for an exact derivative
};

/// Halves the step `halvings` times. The basis functions do not move with the boundary, so the derivative is
/// that of the discrete objective as long as the same cells are cut: the caller chooses shape and step so.
template <int dim>
Expected<TaylorTest> taylor_test(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& objective, const LevelSet<dim>& psi,
    std::span<const double> direction, int map_degree, double step, int halvings);

}  // namespace wheelwright
