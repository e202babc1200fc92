#pragma once

namespace wheelwright {

/// The dilatation on which lambda works in elements of degree 2.
enum class DilatationKind {
  /// lambda + mu / 2 on div u projected on the linear functions of a cell, which does not lock for any nu
  /// below 1/2, and -mu / 2 on div u.
  projected,
  pointwise,  ///< on div u: the displacement element of other programs
};

}  // namespace wheelwright
