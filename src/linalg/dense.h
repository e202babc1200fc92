#pragma once

#include <complex>
#include <vector>

namespace wheelwright {

/// A dense column-major matrix that owns its entries.
template <class Scalar>
class DenseMatrix {
 public:
  DenseMatrix() = default;
  DenseMatrix(int rows, int columns) : rows_(rows), columns_(columns), entries_(size_t(rows) * columns) {}

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  Scalar& operator()(int i, int j) { return entries_[size_t(j) * rows_ + i]; }
  const Scalar& operator()(int i, int j) const { return entries_[size_t(j) * rows_ + i]; }
  Scalar* data() { return entries_.data(); }
  const Scalar* data() const { return entries_.data(); }
  Scalar* column(int j) { return entries_.data() + size_t(j) * rows_; }
  const Scalar* column(int j) const { return entries_.data() + size_t(j) * rows_; }
  std::vector<Scalar>& entries() { return entries_; }
  const std::vector<Scalar>& entries() const { return entries_; }

 private:
  int rows_ = 0, columns_ = 0;
  std::vector<Scalar> entries_;
};

using Matrix = DenseMatrix<double>;
using ComplexMatrix = DenseMatrix<std::complex<double>>;

enum class Op { none, transpose, adjoint };

/// c = alpha op_a(a) op_b(b) + beta c (BLAS gemm); shapes must fit.
void multiply(double alpha, const Matrix& a, Op op_a, const Matrix& b, Op op_b, double beta, Matrix& c);
void multiply(std::complex<double> alpha, const ComplexMatrix& a, Op op_a, const ComplexMatrix& b, Op op_b,
              std::complex<double> beta, ComplexMatrix& c);

/// c = alpha op(a) b + beta c on the first columns of b and c, which have no gaps between them.
void multiply_columns(double alpha, const Matrix& a, Op op, const double* b, int columns, double beta,
                      double* c);

Matrix sum(Matrix a, const Matrix& b);

/// op_a(a) op_b(b).
Matrix product(const Matrix& a, Op op_a, const Matrix& b, Op op_b);

/// Replaces the lower triangle of a Hermitian positive definite matrix by its Cholesky factor; the strict
/// upper triangle is neither read nor written. False when it is not positive definite.
[[nodiscard]] bool cholesky(Matrix& a);
[[nodiscard]] bool cholesky(ComplexMatrix& a);

/// Solves a x = b with cholesky()'s factor; b becomes x.
void cholesky_solve(const Matrix& factor, Matrix& b);
void cholesky_solve(const ComplexMatrix& factor, ComplexMatrix& b);

/// The inverse, both triangles, of a Hermitian positive definite matrix from cholesky()'s factor, in place.
void cholesky_invert(ComplexMatrix& factor);

/// Solves a x = b by LU with partial pivoting; a is destroyed, b becomes x. False when a is singular.
[[nodiscard]] bool lu_solve(Matrix& a, Matrix& b);

}  // namespace wheelwright
