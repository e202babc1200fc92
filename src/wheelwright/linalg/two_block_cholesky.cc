#include "wheelwright/linalg/two_block_cholesky.h"

#include <cblas.h>
#include <lapacke.h>

using Complex = std::complex<double>;

namespace wheelwright {

std::optional<TwoBlockCholesky> TwoBlockCholesky::factor(ComplexMatrix a, int n_first) {
  if (!cholesky(a)) return std::nullopt;
  return TwoBlockCholesky(std::move(a), n_first);
}

void TwoBlockCholesky::eliminate(ComplexMatrix& loads) const {
  const int n = l_.rows(), first = n_first_, last = n_last(), rhs = loads.columns();
  if (first == 0 || rhs == 0) return;
  const Complex one = 1, minus_one = -1;
  cblas_ztrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, first, rhs, &one, l_.data(),
              n, loads.data(), n);
  cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, last, rhs, first, &minus_one, l_.data() + first, n,
              loads.data(), n, &one, loads.data() + first, n);
}

void TwoBlockCholesky::solve_last(ComplexMatrix& loads) const {
  const int n = l_.rows(), last = n_last(), rhs = loads.columns();
  if (last > 0 && rhs > 0)
    LAPACKE_zpotrs_work(LAPACK_COL_MAJOR, 'L', last, rhs, l_.column(n_first_) + n_first_, n, loads.data(),
                        last);
}

void TwoBlockCholesky::substitute(ComplexMatrix& x) const {
  const int n = l_.rows(), first = n_first_, last = n_last(), rhs = x.columns();
  if (first == 0 || rhs == 0) return;
  const Complex one = 1, minus_one = -1;
  cblas_zgemm(CblasColMajor, CblasConjTrans, CblasNoTrans, first, rhs, last, &minus_one, l_.data() + first, n,
              x.data() + first, n, &one, x.data(), n);
  cblas_ztrsm(CblasColMajor, CblasLeft, CblasLower, CblasConjTrans, CblasNonUnit, first, rhs, &one, l_.data(),
              n, x.data(), n);
}

ComplexMatrix TwoBlockCholesky::last_block_of_inverse() const {
  const int last = n_last();
  ComplexMatrix inverse(last, last);
  for (int j = 0; j < last; ++j)
    for (int i = j; i < last; ++i) inverse(i, j) = l_(n_first_ + i, n_first_ + j);
  cholesky_invert(inverse);
  return inverse;
}

}  // namespace wheelwright
