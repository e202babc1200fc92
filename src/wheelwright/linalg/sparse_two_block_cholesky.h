#pragma once

#include <optional>

#include "wheelwright/linalg/partial_cholesky.h"
#include "wheelwright/linalg/two_block_cholesky.h"

namespace wheelwright {

/// As TwoBlockCholesky<double>, for a matrix whose first block is sparse. The last block is dense.
class SparseTwoBlockCholesky {
 public:
  /// Factors `a` with `on_last`, both triangles, added to its last block: the trailing unknowns of the
  /// analysis, whose elimination order must be that of the unknowns. Empty when the sum is not positive
  /// definite.
  static std::optional<SparseTwoBlockCholesky> factor(
      const SparseSymmetric& a, const Matrix& on_last,
      std::shared_ptr<const PartialCholesky::Analysis> analysis);

  int n_first() const { return first_.n_interior(); }
  const PartialCholesky& first() const { return first_; }

  void eliminate(Matrix& loads) const;
  void solve_last(Matrix& loads) const { last_.solve_last(loads); }
  Matrix last_inverse() const { return last_.last_inverse(); }
  void substitute(Matrix& x) const;

 private:
  SparseTwoBlockCholesky(PartialCholesky first, TwoBlockCholesky<double> last)
      : first_(std::move(first)), last_(std::move(last)) {}

  PartialCholesky first_;
  TwoBlockCholesky<double> last_;
};

}  // namespace wheelwright
