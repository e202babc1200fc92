#pragma once

#include <algorithm>
#include <complex>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace wheelwright {

/// An allocator that leaves new entries uninitialized where std::allocator would set them to zero.
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
  /// A matrix of zeros.
  DenseMatrix(int rows, int columns)
      : rows_(rows), columns_(columns), entries_(size_t(rows) * columns, Scalar(0)) {}

  /// A matrix whose entries are uninitialized; the caller must set them all.
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

/// A copy of the block of a with `rows` rows from `first_row` on and `columns` columns from `first_column`
/// on.
template <class Scalar>
DenseMatrix<Scalar> block(const DenseMatrix<Scalar>& a, int first_row, int first_column, int rows,
                          int columns) {
  auto result = DenseMatrix<Scalar>::unfilled(rows, columns);
  for (int j = 0; j < columns; ++j)
    std::copy_n(a.column(first_column + j) + first_row, rows, result.column(j));
  return result;
}

/// A copy of the given columns of a, in the given order.
Matrix selected_columns(const Matrix& a, std::span<const int> columns);

/// Ascending indices of the columns that have an entry other than zero.
std::vector<int> nonzero_columns(const Matrix& a);

/// Returns diag(factors) * a.
Matrix scaled_rows(std::span<const double> factors, Matrix a);

/// The maximum absolute value; NaN if a value is NaN.
double largest_magnitude(std::span<const double> values);
double largest_entry(const Matrix& a);

enum class Op { none, transpose, adjoint };

/// Computes c = alpha * op_a(a) * op_b(b) + beta * c (gemm of BLAS). The shapes must match.
void multiply(double alpha, const Matrix& a, Op op_a, const Matrix& b, Op op_b, double beta, Matrix& c);
void multiply(std::complex<double> alpha, const ComplexMatrix& a, Op op_a, const ComplexMatrix& b, Op op_b,
              std::complex<double> beta, ComplexMatrix& c);

/// Computes c = alpha * a * b + beta * c on some rows of b and c: as many as a has columns and rows, from
/// these ones on.
void multiply_rows(double alpha, const Matrix& a, const Matrix& b, int first_of_b, double beta, Matrix& c,
                   int first_of_c);

/// Computes c = alpha * op(a) * b + beta * c, where b and c are the first entries of contiguous column-major
/// matrices with this number of columns.
void multiply_columns(double alpha, const Matrix& a, Op op, const double* b, int columns, double beta,
                      double* c);

/// Returns a + b.
Matrix sum(Matrix a, const Matrix& b);
Matrix transposed(const Matrix& a);
ComplexMatrix adjoint(const ComplexMatrix& a);

/// Returns op_a(a) * op_b(b).
Matrix product(const Matrix& a, Op op_a, const Matrix& b, Op op_b);

/// Replaces the lower triangle of a symmetric positive definite matrix by its Cholesky factor; the strict
/// upper triangle is neither read nor written. Returns false when the matrix is not positive definite.
[[nodiscard]] bool cholesky(Matrix& a);

/// Solves a * x = b with the factor that cholesky() left in a; b becomes x.
void cholesky_solve(const Matrix& factor, Matrix& b);

/// Solves a * x = b by LU factorization with partial pivoting; a is destroyed and b becomes x. Returns false
/// when a is singular.
[[nodiscard]] bool lu_solve(Matrix& a, Matrix& b);

}  // namespace wheelwright
