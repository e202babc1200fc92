#pragma once

namespace wheelwright {

/// The dilatation on which lambda works in elements of degree 2.
enum class DilatationKind {
  automatic,  ///< pointwise up to nu = 0.4 and in plane stress, projected from 0.48 on, in between in part
  /// lambda + 0.6 mu on div u projected on the linear functions of a cell, which does not lock for any nu
  /// below 1/2, and -0.6 mu on div u.
  projected,
  pointwise,  ///< on div u: the displacement element of other programs
};

}  // namespace wheelwright
