#include "linalg/column_basis.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// Columns that are made orthogonal together.
constexpr int block_size = 16;

double length(const Matrix& a, int column) {
  const double* x = a.column(column);
  double sum = 0;
  for (int i = 0; i < a.rows(); ++i) sum += x[i] * x[i];
  return std::sqrt(sum);
}

/// Takes the components along the basis out of x.
void project_out(const Matrix& basis, Matrix& x) {
  multiply(-1, basis, Op::none, product(basis, Op::transpose, x, Op::none), Op::none, 1, x);
}

Matrix first_columns(const Matrix& a, int n) {
  Matrix result(a.rows(), n);
  std::copy_n(a.data(), result.entries().size(), result.data());
  return result;
}

/// The basis with more columns.
Matrix extended(const Matrix& basis, const Matrix& more) {
  Matrix result(basis.rows(), basis.columns() + more.columns());
  std::copy_n(basis.data(), basis.entries().size(), result.data());
  std::copy_n(more.data(), more.entries().size(), result.column(basis.columns()));
  return result;
}

/// Gram and Schmidt's orthonormal basis of x's columns, the longest remainder first, until none is longer
/// than `shortest`.
Matrix orthonormal(Matrix x, double shortest) {
  int rank = 0;
  for (; rank < x.columns(); ++rank) {
    int longest = rank;
    for (int j = rank + 1; j < x.columns(); ++j)
      if (length(x, j) > length(x, longest)) longest = j;
    const double size = length(x, longest);
    if (!(size > shortest)) break;
    std::swap_ranges(x.column(rank), x.column(rank) + x.rows(), x.column(longest));
    double* q = x.column(rank);
    for (int i = 0; i < x.rows(); ++i) q[i] /= size;
    for (int j = rank + 1; j < x.columns(); ++j) {
      double* y = x.column(j);
      double along = 0;
      for (int i = 0; i < x.rows(); ++i) along += q[i] * y[i];
      for (int i = 0; i < x.rows(); ++i) y[i] -= along * q[i];
    }
  }
  return first_columns(x, rank);
}

}  // namespace

ColumnBasis column_basis(const Matrix& a, double tolerance) {
  double longest = 0;
  for (int j = 0; j < a.columns(); ++j) longest = std::max(longest, length(a, j));
  const double shortest = tolerance * longest;

  Matrix basis(a.rows(), 0);
  const int n_blocks = (a.columns() + block_size - 1) / block_size;
  for (int block = 0; block < n_blocks && longest > 0; ++block) {
    // Neighbouring columns are often alike: a block takes them from all over a.
    Matrix x(a.rows(), (a.columns() - block + n_blocks - 1) / n_blocks);
    for (int k = 0; k < x.columns(); ++k) std::copy_n(a.column(block + k * n_blocks), a.rows(), x.column(k));
    project_out(basis, x);
    Matrix more = orthonormal(std::move(x), shortest);
    if (more.columns() == 0) continue;
    // What rounding left of the basis weighs more in a short remainder: once again.
    project_out(basis, more);
    basis = extended(basis, orthonormal(std::move(more), 0));
  }
  Matrix coordinates = product(basis, Op::transpose, a, Op::none);
  return {std::move(basis), std::move(coordinates)};
}

}  // namespace wheelwright
