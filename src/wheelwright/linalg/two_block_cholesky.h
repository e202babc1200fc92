#pragma once

#include <optional>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// The Cholesky factor of a Hermitian positive definite matrix with two blocks of unknowns, which allows to
/// solve equations block by block. Vectors are columns of a matrix, with the first block on top.
class TwoBlockCholesky {
 public:
  /// Factors the matrix with the lower triangle `a`. Empty when it is not positive definite.
  static std::optional<TwoBlockCholesky> factor(ComplexMatrix a, int n_first);

  int n_last() const { return l_.rows() - n_first_; }

  /// Eliminates the first block in place: loads (f_1, f_2) become (L_11^-1 f_1, f_2 - A_21 A_11^-1 f_1).
  void eliminate(ComplexMatrix& loads) const;

  /// Solves for the last block in place: condensed loads (n_last() rows) become displacements.
  void solve_last(ComplexMatrix& loads) const;

  /// Back substitution in place: (L_11^-1 f_1, x_2) becomes (x_1, x_2).
  void substitute(ComplexMatrix& x) const;

  /// Both triangles of the last block of the inverse matrix.
  ComplexMatrix last_block_of_inverse() const;

 private:
  TwoBlockCholesky(ComplexMatrix l, int n_first) : n_first_(n_first), l_(std::move(l)) {}

  int n_first_;
  ComplexMatrix l_;
};

}  // namespace wheelwright
