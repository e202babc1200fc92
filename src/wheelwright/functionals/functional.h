#pragma once

#include <string>

#include "wheelwright/base/quantity.h"
#include "wheelwright/state/state.h"

namespace wheelwright {

/// A functional at one shape and its states.
template <int dim>
struct FunctionalValue {
  /// The part that depends on the shape alone, and the density of its shape derivative at State::boundary();
  /// empty: zero.
  double of_shape = 0;
  std::vector<double> gradient_of_shape = {};

  /// The part that depends on the states: J_i of every position that was solved for, the same as that of the
  /// position's mirror image; empty: zero. And how it depends on them.
  std::vector<double> by_position = {};
  FunctionalDerivative<dim> derivative = {};

  /// Whether the tread loads are derivatives with respect to deviations from the mean over the positions.
  bool compares_with_mean = false;
};

/// A functional of the form (36): integrals over the material and over its boundary. It depends on the states of
/// the load positions by way of the strain energy, of what the tread observes and of integrals over the
/// material, and on the shape itself. To add one: a file with a class like this, its Taylor test, and its line in
/// the list of functionals (run/functionals.cc).
template <int dim>
class Functional {
 public:
  virtual ~Functional() = default;

  /// As in the case file and in history files.
  virtual std::string name() const = 0;

  /// `mean`: what mean_observations() gives, of these states or held from an earlier shape. The derivative is that
  /// at a held mean.
  virtual FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                        const State<dim>& state, const Matrix& mean) const = 0;
};

}  // namespace wheelwright
