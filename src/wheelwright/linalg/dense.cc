#include "wheelwright/linalg/dense.h"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>

namespace wheelwright {
namespace {

CBLAS_TRANSPOSE cblas_op(Op op) {
  return op == Op::none ? CblasNoTrans : op == Op::transpose ? CblasTrans : CblasConjTrans;
}

/// The arguments of gemm that do not depend on the type of the entries.
struct ProductShape {
  int m, n, k, lda, ldb;
};

template <class Scalar>
ProductShape product_shape(const DenseMatrix<Scalar>& a, Op op_a, const DenseMatrix<Scalar>& b, Op op_b,
                           const DenseMatrix<Scalar>& c) {
  const int k = op_a == Op::none ? a.columns() : a.rows();
  assert((op_a == Op::none ? a.rows() : a.columns()) == c.rows());
  assert((op_b == Op::none ? b.columns() : b.rows()) == c.columns());
  assert((op_b == Op::none ? b.rows() : b.columns()) == k);
  return {
      .m = c.rows(), .n = c.columns(), .k = k, .lda = std::max(1, a.rows()), .ldb = std::max(1, b.rows())};
}

}  // namespace

void multiply(double alpha, const Matrix& a, Op op_a, const Matrix& b, Op op_b, double beta, Matrix& c) {
  const auto [m, n, k, lda, ldb] = product_shape(a, op_a, b, op_b, c);
  if (m == 0 || n == 0) return;
  cblas_dgemm(CblasColMajor, cblas_op(op_a), cblas_op(op_b), m, n, k, alpha, a.data(), lda, b.data(), ldb,
              beta, c.data(), m);
}

void multiply(std::complex<double> alpha, const ComplexMatrix& a, Op op_a, const ComplexMatrix& b, Op op_b,
              std::complex<double> beta, ComplexMatrix& c) {
  const auto [m, n, k, lda, ldb] = product_shape(a, op_a, b, op_b, c);
  if (m == 0 || n == 0) return;
  cblas_zgemm(CblasColMajor, cblas_op(op_a), cblas_op(op_b), m, n, k, &alpha, a.data(), lda, b.data(), ldb,
              &beta, c.data(), m);
}

void multiply_rows(double alpha, const Matrix& a, const Matrix& b, int first_of_b, double beta, Matrix& c,
                   int first_of_c) {
  if (a.rows() == 0 || b.columns() == 0) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, a.rows(), b.columns(), a.columns(), alpha, a.data(),
              a.rows(), b.data() + first_of_b, std::max(1, b.rows()), beta, c.data() + first_of_c, c.rows());
}

void multiply_columns(double alpha, const Matrix& a, Op op, const double* b, int columns, double beta,
                      double* c) {
  const int m = op == Op::none ? a.rows() : a.columns(), k = op == Op::none ? a.columns() : a.rows();
  if (m == 0 || columns == 0) return;
  cblas_dgemm(CblasColMajor, cblas_op(op), CblasNoTrans, m, columns, k, alpha, a.data(),
              std::max(1, a.rows()), b, std::max(1, k), beta, c, m);
}

Matrix selected_columns(const Matrix& a, std::span<const int> columns) {
  auto result = Matrix::unfilled(a.rows(), static_cast<int>(columns.size()));
  for (int j = 0; j < result.columns(); ++j) std::copy_n(a.column(columns[j]), a.rows(), result.column(j));
  return result;
}

std::vector<int> nonzero_columns(const Matrix& a) {
  std::vector<int> columns;
  for (int j = 0; j < a.columns(); ++j) {
    const double* x = a.column(j);
    // The bits without the sign bit are all zero for 0 and -0; the loop uses vector registers.
    std::uint64_t bits = 0;
    for (int i = 0; i < a.rows(); ++i) bits |= std::bit_cast<std::uint64_t>(x[i]) << 1;
    if (bits != 0) columns.push_back(j);
  }
  return columns;
}

Matrix scaled_rows(std::span<const double> factors, Matrix a) {
  for (int j = 0; j < a.columns(); ++j) {
    double* column = a.column(j);
    for (int i = 0; i < a.rows(); ++i) column[i] *= factors[i];
  }
  return a;
}

double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (const double x : values) {
    if (std::isnan(x)) return x;
    largest = std::max(largest, std::abs(x));
  }
  return largest;
}

double largest_entry(const Matrix& a) { return largest_magnitude(a.entries()); }

Matrix sum(Matrix a, const Matrix& b) {
  assert(a.rows() == b.rows() && a.columns() == b.columns());
  std::transform(a.entries().begin(), a.entries().end(), b.entries().begin(), a.entries().begin(),
                 std::plus());
  return a;
}

namespace {

/// Sets result(j, i) = f(a(i, j)).
template <class Scalar, class F>
DenseMatrix<Scalar> turned(const DenseMatrix<Scalar>& a, F f) {
  constexpr int tile = 32;  // fits the cache, by rows and by columns
  auto result = DenseMatrix<Scalar>::unfilled(a.columns(), a.rows());
  for (int j0 = 0; j0 < a.columns(); j0 += tile)
    for (int i0 = 0; i0 < a.rows(); i0 += tile)
      for (int j = j0; j < std::min(j0 + tile, a.columns()); ++j)
        for (int i = i0; i < std::min(i0 + tile, a.rows()); ++i) result(j, i) = f(a(i, j));
  return result;
}

}  // namespace

Matrix transposed(const Matrix& a) {
  return turned(a, [](double x) { return x; });
}

ComplexMatrix adjoint(const ComplexMatrix& a) {
  return turned(a, [](const std::complex<double>& x) { return std::conj(x); });
}

Matrix product(const Matrix& a, Op op_a, const Matrix& b, Op op_b) {
  auto c =
      Matrix::unfilled(op_a == Op::none ? a.rows() : a.columns(), op_b == Op::none ? b.columns() : b.rows());
  multiply(1, a, op_a, b, op_b, 0, c);
  return c;
}

bool cholesky(Matrix& a) {
  const int n = a.rows();
  return n == 0 || LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, a.data(), n) == 0;
}

void cholesky_solve(const Matrix& factor, Matrix& b) {
  const int n = factor.rows(), m = b.columns();
  if (n > 0 && m > 0) LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'L', n, m, factor.data(), n, b.data(), n);
}

bool lu_solve(Matrix& a, Matrix& b) {
  const int n = a.rows(), m = b.columns();
  std::vector<int> pivots(n);
  return n == 0 || LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, m, a.data(), n, pivots.data(), b.data(), n) == 0;
}

}  // namespace wheelwright
