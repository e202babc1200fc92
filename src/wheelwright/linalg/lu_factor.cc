#include "wheelwright/linalg/lu_factor.h"

#include <lapacke.h>

#include <utility>

namespace wheelwright {

std::optional<LuFactor> LuFactor::factor(Matrix a) {
  const int n = a.rows();
  LuFactor result;
  result.lu_ = std::move(a);
  result.pivots_.resize(n);
  if (n > 0 && LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, result.lu_.data(), n, result.pivots_.data()) != 0)
    return {};
  return result;
}

Matrix LuFactor::solve(Matrix b) const {
  const int n = lu_.rows();
  if (n > 0)
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, b.columns(), lu_.data(), n, pivots_.data(), b.data(), n);
  return b;
}

}  // namespace wheelwright
