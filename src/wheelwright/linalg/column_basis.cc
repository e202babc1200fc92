#include "wheelwright/linalg/column_basis.h"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wheelwright {
namespace {

/// Number of columns that are orthogonalized together.
constexpr int block_size = 32;

double length(const Matrix& a, int column) {
  const double* x = a.column(column);
  // Four partial sums let the compiler use vector registers.
  std::array<double, 4> sums{};
  int i = 0;
  for (; i + 4 <= a.rows(); i += 4)
    for (int k = 0; k < 4; ++k) sums[k] += x[i + k] * x[i + k];
  for (; i < a.rows(); ++i) sums[0] += x[i] * x[i];
  return std::sqrt(sums[0] + sums[1] + (sums[2] + sums[3]));
}

/// Projects the columns of x onto the orthogonal complement of the basis.
void project_out(const Matrix& basis, Matrix& x) {
  multiply(-1, basis, Op::none, product(basis, Op::transpose, x, Op::none), Op::none, 1, x);
}

/// Returns the columns that are longer than `shortest`.
Matrix long_columns(const Matrix& a, double shortest) {
  auto result = Matrix::unfilled(a.rows(), a.columns());
  int n = 0;
  for (int j = 0; j < a.columns(); ++j)
    if (length(a, j) > shortest) std::copy_n(a.column(j), a.rows(), result.column(n++));
  return block(result, 0, 0, a.rows(), n);
}

/// Appends columns to the basis.
Matrix extended(const Matrix& basis, const Matrix& more) {
  auto result = Matrix::unfilled(basis.rows(), basis.columns() + more.columns());
  std::copy_n(basis.data(), basis.entries().size(), result.data());
  std::copy_n(more.data(), more.entries().size(), result.column(basis.columns()));
  return result;
}

/// Truncated pivoted QR: an orthonormal basis of the columns of x. Each step takes the column with the
/// longest remainder; the factorization ends when no remainder is longer than `shortest`.
Matrix orthonormal(Matrix x, double shortest) {
  const int m = x.rows(), n = x.columns();
  std::vector<int> pivots(n, 0);
  std::vector<double> reflectors(n), workspace(size_t(64) * (n + 1));
  const int workspace_size = static_cast<int>(workspace.size());
  if (n == 0) return x;
  LAPACKE_dgeqp3_work(LAPACK_COL_MAJOR, m, n, x.data(), m, pivots.data(), reflectors.data(), workspace.data(),
                      workspace_size);
  int rank = 0;
  while (rank < std::min(m, n) && std::abs(x(rank, rank)) > shortest) ++rank;
  LAPACKE_dorgqr_work(LAPACK_COL_MAJOR, m, rank, rank, x.data(), m, reflectors.data(), workspace.data(),
                      workspace_size);
  return block(x, 0, 0, m, rank);
}

/// Orthonormalizes columns that are nearly orthonormal already, by Cholesky QR.
void orthonormalize(Matrix& x) {
  Matrix gram = product(x, Op::transpose, x, Op::none);
  const int m = x.rows(), n = x.columns();
  if (!cholesky(gram)) return;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1, gram.data(), n,
              x.data(), m);
}

}  // namespace

ColumnBasis column_basis(const Matrix& a, double tolerance) {
  double longest = 0;
  for (int j = 0; j < a.columns(); ++j) longest = std::max(longest, length(a, j));
  const double shortest = tolerance * longest;

  Matrix basis(a.rows(), 0);
  const int n_blocks = (a.columns() + block_size - 1) / block_size;
  for (int block = 0; block < n_blocks && longest > 0; ++block) {
    // Neighbouring columns are often similar, so that each block takes columns spread over all of a.
    auto x = Matrix::unfilled(a.rows(), (a.columns() - block + n_blocks - 1) / n_blocks);
    for (int k = 0; k < x.columns(); ++k) std::copy_n(a.column(block + k * n_blocks), a.rows(), x.column(k));
    project_out(basis, x);
    Matrix more = orthonormal(long_columns(x, shortest), shortest);
    if (more.columns() == 0) continue;
    // Rounding left components along the basis, which weigh more in the now normalized remainders: project
    // again.
    project_out(basis, more);
    orthonormalize(more);
    basis = extended(basis, more);
  }
  Matrix coordinates = product(basis, Op::transpose, a, Op::none);
  return {std::move(basis), std::move(coordinates)};
}

}  // namespace wheelwright
