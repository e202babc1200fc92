#pragma once

#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// The Taylor test of one function's shape gradient, or of its derivative with respect to a radius.
struct GradientCheck {
  static constexpr double wanted_order = 1.9, max_error = 0.1;

  std::string function;  ///< its name, e.g. "objective"
  TaylorTest test;
  /// Whether the function is a maximum, whose gradient is deliberately that of a smooth approximation: a
  /// p-norm (PeakNorm) or a smooth maximum over the positions. Its value is no reference for that gradient.
  bool is_smoothed = false;
  std::string radius = {};  ///< DesignRadius::name; empty: the shape's gradient

  /// Whether the remainder of a step is rounding.
  bool is_rounding(size_t step) const;

  /// The lowest order of the remainders above rounding; infinite if all of them are rounding.
  double lowest_order() const;

  /// The largest difference, beyond rounding, between a difference quotient and the derivative, as a fraction
  /// of the derivative.
  double largest_error() const;

  /// Whether the remainders fall with the square of the step, or are rounding, and the derivative dominates
  /// each change.
  bool passed() const;

  /// Whether the gradient is wrong.
  bool failed() const { return !is_smoothed && !passed(); }
};

/// Perturbations of a level set to test its gradients: the number selects one of several smooth fields.
/// Vanish at nodes of cells that would start or cease to be cut within +-step, e.g. at edges held by a
/// protected band.
template <int dim>
std::vector<double> test_direction(const LevelSet<dim>& psi, int number, double step);

/// The shape beside a given one at which its gradients are tested: at the shape itself edges may lie on
/// nodes, and a symmetric wheel is solved only in part. Twice the step away along a direction.
template <int dim>
LevelSet<dim> generic_shape(LevelSet<dim> psi, std::span<const double> direction, double step);

/// The largest step of those tests on a grid [m].
template <int dim>
double largest_test_step(const PolarGrid<dim>& grid);

/// Tests the gradients of all functions of a study a fraction of a cell away from a shape, with the
/// quadrature of a run. Steps within which a point of the tread changes its contact status are reduced; a
/// function that fails is tested along other directions, so that only a wrong gradient fails. Fails as the
/// evaluation of the shape does, and with empty_shape if no part of the boundary can move.
template <int dim>
Expected<std::vector<GradientCheck>> check_gradients(const Study<dim>& study, const LevelSet<dim>& shape,
                                                     const Interrupt& interrupt = {});

/// Tests the derivatives of all functions of a study with respect to the radii of layers that its case
/// chooses (case/design_radii.h), radius by radius; the shape moves with the rows of cells. Steps and
/// retries, from other radii, are as for gradients. Empty if there are no such radii.
template <int dim>
Expected<std::vector<GradientCheck>> check_radii(const Study<dim>& study, const LevelSet<dim>& shape,
                                                 const Interrupt& interrupt = {});

}  // namespace wheelwright
