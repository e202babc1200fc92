#pragma once

#include <optional>
#include <string>

#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {

/// A functional at one shape and its states.
template <int dim>
struct FunctionalValue {
  /// The part that depends only on the shape, and the density of its shape derivative at State::boundary();
  /// empty: zero.
  double of_shape = 0;
  std::vector<double> gradient_of_shape = {};
  /// The density at State::edges(), where the moving boundary meets the side faces; empty: zero.
  std::vector<double> edge_gradient_of_shape = {};
  /// Its derivatives with respect to the radii of the model's design lines, as ShapeGradients::by_radius;
  /// empty: zero.
  std::vector<double> by_radius_of_shape = {};

  /// The part that depends on the states: J_i of every position that was solved for, which is also that of
  /// the position's mirror image. Empty: zero.
  std::vector<double> by_position = {};

  /// In place of by_position: a value of all positions together, in which no position has a share of its own.
  /// Weights per position do not apply to it.
  std::optional<double> over_positions = {};

  /// The derivative of the part that depends on the states. With over_positions, a position's entries are per
  /// position that it represents.
  FunctionalDerivative<dim> derivative = {};

  /// Whether the tread loads are derivatives with respect to the deviations from the mean over the positions.
  bool compares_with_mean = false;
};

/// A functional of the form (36): integrals over the material and over its boundary. It depends on the shape
/// itself, and on the states of the load positions through the strain energy, the observations of the tread
/// and integrals over the material. To add one, write a file with a class like this and its Taylor test, and
/// its row to the table of quantities (quantities/functionals/quantities.cc).
template <int dim>
class Functional {
 public:
  virtual ~Functional() = default;

  /// The name in case files and in history files.
  virtual std::string name() const = 0;

  /// The value at a shape and its states. `mean` is the result of mean_observations() for these states, or
  /// one held from an earlier shape. The derivative is taken at a fixed mean.
  virtual FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                        const State<dim>& state, const Matrix& mean) const = 0;

  /// Whether it has the same value at a state and at its mirror image in a plane: then symmetric wheels are
  /// solved in half of their positions, or on half of their width. Without such a promise all positions and
  /// the whole width are solved. A functional of the shape alone does not depend on it and returns true.
  virtual bool is_mirror_symmetric(MirrorPlane) const { return false; }

  /// The change by a small round hole in every sector of the part that depends only on the shape, per area of
  /// the hole (volume when dim = 3). `x`: its centre, Cartesian, in the body frame [m]; `radius` [m].
  virtual double of_small_hole(const PolarGrid<dim>& /*grid*/, const Vec<dim>& /*x*/,
                               double /*radius*/) const {
    return 0;
  }
};

}  // namespace wheelwright
