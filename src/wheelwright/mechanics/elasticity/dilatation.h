#pragma once

namespace wheelwright {

/// Which dilatation an element of degree 2 has in its energy and in its pressure.
enum class DilatationKind {
  /// div u projected on the linear functions of a cell: the mixed element of quadratic displacement and
  /// discontinuous, linear pressure, which does not lock for any nu below 1/2.
  projected,
  pointwise,  ///< div u itself: the displacement element of other programs
};

}  // namespace wheelwright
