#pragma once

#include <memory>
#include <span>

#include "base/expected.h"
#include "linalg/dense.h"
#include "linalg/sparse_symmetric.h"

namespace wheelwright {

/// Static condensation of a sparse symmetric matrix onto its trailing unknowns t, by one supernodal Cholesky
/// factorization (CHOLMOD) of the whole: with i the interior unknowns, schur = K_tt - K_ti K_ii^-1 K_it.
/// K_ii must be positive definite; K_tt need not be (empty rows are fine).
/// Vectors "in elimination order" hold the interior unknowns first, the trailing ones last.
class PartialCholesky {
 public:
  /// `order[k]` is the unknown eliminated k-th; its last n_trailing ones are the trailing unknowns, in the
  /// order that schur() keeps. Fails with not_positive_definite.
  static Expected<PartialCholesky> factor(const SparseSymmetric& matrix, std::span<const int> order,
                                          int n_trailing);

  int size() const;
  int n_trailing() const { return schur_.rows(); }
  const Matrix& schur() const { return schur_; }  ///< full symmetric
  double factor_entries() const;                  ///< nonzeros of the factor
  double factor_flops() const;                    ///< of the numerical factorization

  /// Forward elimination of loads f (elimination order, one a column), in place: the interior rows become
  /// L_ii^-1 f_i, the trailing rows the condensed loads f_t - K_ti K_ii^-1 f_i.
  void eliminate(Matrix& loads) const;

  /// Back substitution in place: takes eliminate()'s interior rows (zero for no interior load) and the
  /// trailing displacements; the interior rows become the interior displacements.
  void substitute(Matrix& x) const;

  PartialCholesky(PartialCholesky&&) noexcept;
  PartialCholesky& operator=(PartialCholesky&&) noexcept;
  ~PartialCholesky();

 private:
  struct Factor;
  PartialCholesky(std::unique_ptr<Factor> factor, Matrix schur, Matrix trailing_factor);
  void apply_trailing(Op op, Matrix& x) const;

  std::unique_ptr<Factor> factor_;
  Matrix schur_;
  Matrix trailing_factor_;  ///< L_tt, lower triangular
};

}  // namespace wheelwright
