#pragma once

#include <functional>
#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/optimization/sensitivity/evaluation.h"

namespace wheelwright {

/// d/dt J(psi + t direction) at t = 0 from its shape gradient: the boundary moves with normal velocity
/// -direction / |grad psi|. `direction` has one value per node of psi's lattice [m]; `map_degree` is the
/// degree of the cells' geometry in the evaluation, the displacement's.
template <int dim>
double directional_derivative(const std::vector<SurfaceSample<dim>>& gradient, const LevelSet<dim>& psi,
                              std::span<const double> direction, int map_degree);

/// The derivatives with respect to the nodal values of psi, one per node of its lattice: the directional
/// derivative is their sum, weighted by the direction.
template <int dim>
std::vector<double> nodal_gradient(const std::vector<SurfaceSample<dim>>& gradient, const LevelSet<dim>& psi,
                                   int map_degree);

/// That of every function of an evaluation of psi, in their order, with the parts at edges.
template <int dim>
std::vector<double> directional_derivatives(const Evaluation<dim>& start, const LevelSet<dim>& psi,
                                            std::span<const double> direction, int map_degree);

/// The error of the linear prediction: |J(t) - J(0) - t J'(0)| for t = step, step/2, ...
struct TaylorTest {
  double value, derivative;
  std::vector<double> steps;
  std::vector<double> remainders;
  std::vector<double> orders;  ///< log2 of successive remainders' ratios: 2 for an exact derivative
};

/// The tests of all functions of an evaluation, in their order. `start`: the evaluation of psi itself. Halves
/// the step `halvings` times. The basis functions do not move with the boundary, so the derivative is that of
/// the discrete function as long as the same cells are cut: the caller must choose shape and step
/// accordingly.
template <int dim>
Expected<std::vector<TaylorTest>> taylor_tests(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& evaluate,
    const Evaluation<dim>& start, const LevelSet<dim>& psi, std::span<const double> direction, int map_degree,
    double step, int halvings);

/// The same along any path of evaluations, from the derivatives of the functions at its start, t = 0.
template <int dim>
Expected<std::vector<TaylorTest>> taylor_tests(
    const std::function<Expected<Evaluation<dim>>(double)>& evaluate_at, const Evaluation<dim>& start,
    std::span<const double> derivatives, double step, int halvings);

/// The same of the function of that name.
template <int dim>
Expected<TaylorTest> taylor_test(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& evaluate, const LevelSet<dim>& psi,
    std::span<const double> direction, int map_degree, double step, int halvings,
    std::string_view name = "objective");

}  // namespace wheelwright
