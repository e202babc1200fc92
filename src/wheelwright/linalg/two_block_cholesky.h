#pragma once

#include <optional>

#include "wheelwright/linalg/packed_lower.h"

namespace wheelwright {

/// The Cholesky factor of a symmetric or Hermitian positive definite matrix with two blocks of unknowns,
/// which allows to solve equations block by block. Vectors are columns of a matrix, with the first block on
/// top. `Scalar`: double or std::complex<double>.
template <class Scalar>
class TwoBlockCholesky {
 public:
  /// Factors the matrix with the lower triangle `a` in its place; its first block are the first n_first()
  /// unknowns. Empty when it is not positive definite.
  static std::optional<TwoBlockCholesky> factor(PackedLower<Scalar> a);

  int n_first() const { return l_.n_first(); }

  /// Eliminates the first block in place: loads (f_1, f_2) become (L_11^-1 f_1, f_2 - A_21 A_11^-1 f_1).
  void eliminate(DenseMatrix<Scalar>& loads) const;

  /// Solves for the last block in place: condensed loads (n_last() rows) become displacements.
  void solve_last(DenseMatrix<Scalar>& loads) const;

  /// The last block of the inverse, both triangles: all that solve_last() can return.
  DenseMatrix<Scalar> last_inverse() const;

  /// Back substitution in place: (L_11^-1 f_1, x_2) becomes (x_1, x_2).
  void substitute(DenseMatrix<Scalar>& x) const;

 private:
  using Panel = typename PackedLower<Scalar>::Panel;

  explicit TwoBlockCholesky(PackedLower<Scalar> l) : l_(std::move(l)) {}
  const Scalar* diagonal(const Panel& panel) const { return &l_(panel.first, panel.first); }

  /// One panel's step of the forward and of the backward solution; the rows of x begin with unknown
  /// `first_row`.
  void forward(const Panel& panel, int first_row, DenseMatrix<Scalar>& x) const;
  void backward(const Panel& panel, int first_row, DenseMatrix<Scalar>& x) const;

  PackedLower<Scalar> l_;
};

}  // namespace wheelwright
