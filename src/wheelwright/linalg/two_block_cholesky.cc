#include "wheelwright/linalg/two_block_cholesky.h"

using Complex = std::complex<double>;

extern "C" {
void ztrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const Complex*,
            const Complex*, const int*, Complex*, const int*);
void zgemm_(const char*, const char*, const int*, const int*, const int*, const Complex*, const Complex*,
            const int*, const Complex*, const int*, const Complex*, Complex*, const int*);
void zpotrs_(const char*, const int*, const int*, const Complex*, const int*, Complex*, const int*, int*);
}

namespace wheelwright {

std::optional<TwoBlockCholesky> TwoBlockCholesky::factor(ComplexMatrix a, int n_first) {
  if (!cholesky(a)) return std::nullopt;
  return TwoBlockCholesky(std::move(a), n_first);
}

void TwoBlockCholesky::eliminate(ComplexMatrix& loads) const {
  const int n = l_.rows(), first = n_first_, last = n_last(), rhs = loads.columns();
  if (first == 0 || rhs == 0) return;
  const Complex one = 1, minus_one = -1;
  ztrsm_("L", "L", "N", "N", &first, &rhs, &one, l_.data(), &n, loads.data(), &n);
  zgemm_("N", "N", &last, &rhs, &first, &minus_one, l_.data() + first, &n, loads.data(), &n, &one,
         loads.data() + first, &n);
}

void TwoBlockCholesky::solve_last(ComplexMatrix& loads) const {
  const int n = l_.rows(), last = n_last(), rhs = loads.columns();
  int info = 0;
  if (last > 0 && rhs > 0)
    zpotrs_("L", &last, &rhs, l_.column(n_first_) + n_first_, &n, loads.data(), &last, &info);
}

void TwoBlockCholesky::substitute(ComplexMatrix& x) const {
  const int n = l_.rows(), first = n_first_, last = n_last(), rhs = x.columns();
  if (first == 0 || rhs == 0) return;
  const Complex one = 1, minus_one = -1;
  zgemm_("C", "N", &first, &rhs, &last, &minus_one, l_.data() + first, &n, x.data() + first, &n, &one,
         x.data(), &n);
  ztrsm_("L", "L", "C", "N", &first, &rhs, &one, l_.data(), &n, x.data(), &n);
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
