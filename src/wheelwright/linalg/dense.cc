#include "wheelwright/linalg/dense.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
void zgemm_(const char*, const char*, const int*, const int*, const int*, const std::complex<double>*,
            const std::complex<double>*, const int*, const std::complex<double>*, const int*,
            const std::complex<double>*, std::complex<double>*, const int*);
void dpotrf_(const char*, const int*, double*, const int*, int*);
void zpotrf_(const char*, const int*, std::complex<double>*, const int*, int*);
void dpotrs_(const char*, const int*, const int*, const double*, const int*, double*, const int*, int*);
void zpotri_(const char*, const int*, std::complex<double>*, const int*, int*);
void dgesv_(const int*, const int*, double*, const int*, int*, double*, const int*, int*);
}

namespace wheelwright {
namespace {

char letter(Op op) { return op == Op::none ? 'N' : op == Op::transpose ? 'T' : 'C'; }

template <class Scalar, class Gemm>
void multiply_with(Gemm gemm, Scalar alpha, const DenseMatrix<Scalar>& a, Op op_a,
                   const DenseMatrix<Scalar>& b, Op op_b, Scalar beta, DenseMatrix<Scalar>& c) {
  const int m = c.rows(), n = c.columns(), k = op_a == Op::none ? a.columns() : a.rows();
  assert((op_a == Op::none ? a.rows() : a.columns()) == m);
  assert((op_b == Op::none ? b.columns() : b.rows()) == n);
  assert((op_b == Op::none ? b.rows() : b.columns()) == k);
  if (m == 0 || n == 0) return;
  const char ta = letter(op_a), tb = letter(op_b);
  const int lda = std::max(1, a.rows()), ldb = std::max(1, b.rows());
  gemm(&ta, &tb, &m, &n, &k, &alpha, a.data(), &lda, b.data(), &ldb, &beta, c.data(), &m);
}

}  // namespace

void multiply(double alpha, const Matrix& a, Op op_a, const Matrix& b, Op op_b, double beta, Matrix& c) {
  multiply_with(dgemm_, alpha, a, op_a, b, op_b, beta, c);
}

void multiply(std::complex<double> alpha, const ComplexMatrix& a, Op op_a, const ComplexMatrix& b, Op op_b,
              std::complex<double> beta, ComplexMatrix& c) {
  multiply_with(zgemm_, alpha, a, op_a, b, op_b, beta, c);
}

void multiply_columns(double alpha, const Matrix& a, Op op, const double* b, int columns, double beta,
                      double* c) {
  const int m = op == Op::none ? a.rows() : a.columns(), k = op == Op::none ? a.columns() : a.rows();
  if (m == 0 || columns == 0) return;
  const char ta = letter(op), none = 'N';
  const int lda = std::max(1, a.rows()), ldb = std::max(1, k);
  dgemm_(&ta, &none, &m, &columns, &k, &alpha, a.data(), &lda, b, &ldb, &beta, c, &m);
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
    // Bits without that of the sign, so that the loop goes through vector registers.
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

double largest_entry(const Matrix& a) {
  double largest = 0;
  for (const double x : a.entries()) {
    if (std::isnan(x)) return x;
    largest = std::max(largest, std::abs(x));
  }
  return largest;
}

Matrix sum(Matrix a, const Matrix& b) {
  assert(a.rows() == b.rows() && a.columns() == b.columns());
  std::transform(a.entries().begin(), a.entries().end(), b.entries().begin(), a.entries().begin(),
                 std::plus());
  return a;
}

Matrix product(const Matrix& a, Op op_a, const Matrix& b, Op op_b) {
  auto c =
      Matrix::unfilled(op_a == Op::none ? a.rows() : a.columns(), op_b == Op::none ? b.columns() : b.rows());
  multiply(1, a, op_a, b, op_b, 0, c);
  return c;
}

bool cholesky(Matrix& a) {
  const int n = a.rows();
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a.data(), &n, &info);
  return info == 0;
}

bool cholesky(ComplexMatrix& a) {
  const int n = a.rows();
  int info = 0;
  if (n > 0) zpotrf_("L", &n, a.data(), &n, &info);
  return info == 0;
}

void cholesky_solve(const Matrix& factor, Matrix& b) {
  const int n = factor.rows(), m = b.columns();
  int info = 0;
  if (n > 0 && m > 0) dpotrs_("L", &n, &m, factor.data(), &n, b.data(), &n, &info);
}

void cholesky_invert(ComplexMatrix& factor) {
  const int n = factor.rows();
  int info = 0;
  if (n > 0) zpotri_("L", &n, factor.data(), &n, &info);
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) factor(j, i) = std::conj(factor(i, j));
}

bool lu_solve(Matrix& a, Matrix& b) {
  const int n = a.rows(), m = b.columns();
  std::vector<int> pivots(n);
  int info = 0;
  if (n > 0) dgesv_(&n, &m, a.data(), &n, pivots.data(), b.data(), &n, &info);
  return info == 0;
}

}  // namespace wheelwright
