#pragma once

namespace wheelwright {

/// The dilatation on which the bulk modulus K = lambda + 2 mu / dim of an element of degree 2 works.
enum class DilatationKind {
  /// All of K but mu / 2 on div u projected on the linear functions of a cell, which does not lock for any nu
  /// below 1/2, and the rest on div u.
  projected,
  pointwise,  ///< on div u: the displacement element of other programs
};

}  // namespace wheelwright
