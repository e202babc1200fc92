#pragma once

#include <algorithm>
#include <complex>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace wheelwright {

/// Leaves new entries without a value where std::allocator would set them to zero.
template <class T>
struct NoInitialization : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = NoInitialization<U>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (place) U(std::forward<Arguments>(arguments)...);
  }
};

/// A dense column-major matrix that owns its entries.
template <class Scalar>
class DenseMatrix {
 public:
  DenseMatrix() = default;
  /// Of zeros.
  DenseMatrix(int rows, int columns)
      : rows_(rows), columns_(columns), entries_(size_t(rows) * columns, Scalar(0)) {}

  /// To be filled: its entries have no value yet.
  static DenseMatrix unfilled(int rows, int columns) {
    DenseMatrix result;
    result.rows_ = rows;
    result.columns_ = columns;
    result.entries_.resize(size_t(rows) * columns);
    return result;
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  Scalar& operator()(int i, int j) { return entries_[size_t(j) * rows_ + i]; }
  const Scalar& operator()(int i, int j) const { return entries_[size_t(j) * rows_ + i]; }
  Scalar* data() { return entries_.data(); }
  const Scalar* data() const { return entries_.data(); }
  Scalar* column(int j) { return entries_.data() + size_t(j) * rows_; }
  const Scalar* column(int j) const { return entries_.data() + size_t(j) * rows_; }
  using Entries = std::vector<Scalar, NoInitialization<Scalar>>;
  Entries& entries() { return entries_; }
  const Entries& entries() const { return entries_; }

 private:
  int rows_ = 0, columns_ = 0;
  Entries entries_;
};

using Matrix = DenseMatrix<double>;
using ComplexMatrix = DenseMatrix<std::complex<double>>;

/// The part of a with `rows` rows from `first_row` on and `columns` columns from `first_column` on.
template <class Scalar>
DenseMatrix<Scalar> block(const DenseMatrix<Scalar>& a, int first_row, int first_column, int rows,
                          int columns) {
  auto result = DenseMatrix<Scalar>::unfilled(rows, columns);
  for (int j = 0; j < columns; ++j)
    std::copy_n(a.column(first_column + j) + first_row, rows, result.column(j));
  return result;
}

/// Some columns of a, and the numbers of those that are not all zeros.
Matrix selected_columns(const Matrix& a, std::span<const int> columns);
std::vector<int> nonzero_columns(const Matrix& a);

/// diag(factors) a.
Matrix scaled_rows(std::span<const double> factors, Matrix a);

/// The largest absolute value of an entry; NaN if one is NaN.
double largest_entry(const Matrix& a);

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

/// The inverse, both triangles, of a Hermitian positive definite matrix from cholesky()'s factor, in place.
void cholesky_invert(ComplexMatrix& factor);

/// Solves a x = b by LU with partial pivoting; a is destroyed, b becomes x. False when a is singular.
[[nodiscard]] bool lu_solve(Matrix& a, Matrix& b);

}  // namespace wheelwright
