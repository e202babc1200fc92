#pragma once

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// {psi = 0} in the full ring, evaluated at any point of space: the piecewise polynomial in polar
/// coordinates, in Cartesian coordinates [m] of the body frame. Outside the ring the polynomials of its
/// outermost cells are continued.
class ZeroSurface {
 public:
  explicit ZeroSurface(const LevelSet<3>& psi) : psi_(psi), grid_(psi.lattice.grid()) {}

  struct Value {
    double psi;  ///< [m]
    Vec<3> gradient;

    double distance() const { return std::abs(psi) / norm(gradient); }  ///< to first order [m]
  };
  Value at(const Vec<3>& point) const;

 private:
  LevelSet<3> psi_;
  PolarGrid<3> grid_;
};

}  // namespace wheelwright
