#pragma once

#include <utility>
#include <vector>

#include "wheelwright/shape/evolution/jet.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Piecewise tensor-product cubic through the nodal values of a level set, in polar coordinates: on each
/// element of the lattice it is the Lagrange polynomial of the four nearest nodes along each axis, of unequal
/// distances where rows of unequal height meet. It is
/// continuous and of fourth order for both degrees of the level set. It refers to the level set, which must
/// outlive it.
template <int dim>
class CubicInterpolant {
 public:
  explicit CubicInterpolant(const LevelSet<dim>& psi);

  /// Evaluates the interpolant at a point in units of the node spacing of the lattice: the node at lattice
  /// position p lies at the point p. The azimuth is periodic.
  Jet<dim> operator()(const Vec<dim>& point) const;

  /// The nodes on which the value at a point depends, with their weights.
  std::vector<std::pair<int, double>> weights(const Vec<dim>& point) const;

  const LevelSet<dim>& level_set() const { return *psi_; }
  const Lattice<dim>& lattice() const { return psi_->lattice; }

 private:
  static constexpr int max_points = 4;
  struct AxisBasis {
    std::array<int, max_points> offset;  ///< of the interpolation nodes in the nodal values
    std::array<std::array<double, max_points>, 3> derivative;  ///< of order 0, 1 and 2
  };
  AxisBasis axis_basis(int axis, double coordinate) const;

  const LevelSet<dim>* psi_;
  std::array<int, dim> strides_;
  /// Number of interpolation points along each axis: 4, or fewer on a tiny lattice.
  std::array<int, dim> n_points_;
};

}  // namespace wheelwright
