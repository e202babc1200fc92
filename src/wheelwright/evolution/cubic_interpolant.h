#pragma once

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Value and derivatives of a function in the orthonormal frame (radial, azimuthal[, axial]) at the point.
template <int dim>
struct Jet {
  double value;
  Vec<dim> gradient;
  Mat<dim> hessian;
};

/// Piecewise tensor-product cubic through the nodal values of a level set, in polar coordinates: on each
/// lattice element the Lagrange polynomial of the four nearest nodes along each axis. Continuous, of fourth
/// order whatever the degree of the level set. Refers to the level set, which must outlive it.
template <int dim>
class CubicInterpolant {
 public:
  explicit CubicInterpolant(const LevelSet<dim>& psi);

  /// At a point in units of the lattice's node spacing: node `position` lies at exactly that point. Azimuth
  /// is taken periodically.
  Jet<dim> operator()(const Vec<dim>& point) const;

  const LevelSet<dim>& level_set() const { return *psi_; }
  const Lattice<dim>& lattice() const { return psi_->lattice; }

 private:
  static constexpr int max_points = 4;
  struct AxisBasis {
    std::array<int, max_points> offset;                        ///< of the points' nodes in the nodal values
    std::array<std::array<double, max_points>, 3> derivative;  ///< of order 0, 1, 2
  };
  AxisBasis axis_basis(int axis, double coordinate) const;

  const LevelSet<dim>* psi_;
  std::array<int, dim> strides_;
  std::array<int, dim> n_points_;  ///< interpolation points along each axis: 4, fewer on a tiny lattice
};

}  // namespace wheelwright
