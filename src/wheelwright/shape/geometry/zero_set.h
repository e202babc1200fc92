#pragma once

#include <optional>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The curve {psi = 0} in a plane, for a psi that can be evaluated at any point.
class ZeroSet {
 public:
  virtual ~ZeroSet() = default;

  struct Value {
    double psi;  ///< [m]
    Vec<2> gradient;
  };
  virtual Value at(const Vec<2>& point) const = 0;

  /// The point of the curve reached by Newton's method along the gradient from a nearby point; to second
  /// order in its distance it is the nearest one. Empty if the iteration does not converge within a cell.
  std::optional<Vec<2>> projection(const Vec<2>& point) const;

 protected:
  /// `size`: of the whole, relative to which points are equal; `cell`: length of a cell [m].
  ZeroSet(double size, double cell) : size_(size), cell_(cell) {}
  ZeroSet(const ZeroSet&) = default;
  ZeroSet& operator=(const ZeroSet&) = default;

 private:
  double size_, cell_;
};

}  // namespace wheelwright
