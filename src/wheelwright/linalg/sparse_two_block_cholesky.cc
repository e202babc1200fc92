#include "wheelwright/linalg/sparse_two_block_cholesky.h"

namespace wheelwright {

std::optional<SparseTwoBlockCholesky> SparseTwoBlockCholesky::factor(
    const SparseSymmetric& a, const Matrix& on_last,
    std::shared_ptr<const PartialCholesky::Analysis> analysis) {
  auto first = PartialCholesky::factor(a, std::move(analysis));
  if (!first) return std::nullopt;
  const Matrix condensed = first->release_schur();
  const int n = condensed.rows();
  PackedLower<double> packed(n, 0);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) packed(i, j) = condensed(i, j) + on_last(i, j);
  auto last = TwoBlockCholesky<double>::factor(std::move(packed));
  if (!last) return std::nullopt;
  return SparseTwoBlockCholesky(*std::move(first), *std::move(last));
}

void SparseTwoBlockCholesky::eliminate(Matrix& loads) const {
  if (loads.columns() == 0) return;
  Matrix by_row = transposed(loads);
  first_.eliminate(first_.full_sweep(), by_row);
  loads = transposed(by_row);
}

void SparseTwoBlockCholesky::substitute(Matrix& x) const {
  if (x.columns() == 0) return;
  Matrix by_row = transposed(x);
  first_.substitute(first_.full_sweep(), by_row);
  x = transposed(by_row);
}

}  // namespace wheelwright
