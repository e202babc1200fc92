#include "wheelwright/linalg/two_block_cholesky.h"

#include <cblas.h>
#include <lapacke.h>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

using Complex = std::complex<double>;

// The kernels of BLAS and LAPACK for both kinds of numbers; matrices are column-major, lower triangles.

int cholesky(int n, double* a, int lda) { return LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, a, lda); }
int cholesky(int n, Complex* a, int lda) { return LAPACKE_zpotrf_work(LAPACK_COL_MAJOR, 'L', n, a, lda); }

/// The lower triangle of (l l^H)^-1 in the place of l.
int invert(int n, double* l) { return LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, l, n); }
int invert(int n, Complex* l) { return LAPACKE_zpotri_work(LAPACK_COL_MAJOR, 'L', n, l, n); }

double conjugate(double x) { return x; }
Complex conjugate(const Complex& x) { return std::conj(x); }

/// b = op(l)^-1 b from the left, or b = b op(l)^-1 from the right.
void solve_triangle(CBLAS_SIDE side, bool adjoint, int m, int n, const double* l, int ldl, double* b,
                    int ldb) {
  cblas_dtrsm(CblasColMajor, side, CblasLower, adjoint ? CblasTrans : CblasNoTrans, CblasNonUnit, m, n, 1, l,
              ldl, b, ldb);
}
void solve_triangle(CBLAS_SIDE side, bool adjoint, int m, int n, const Complex* l, int ldl, Complex* b,
                    int ldb) {
  const Complex one = 1;
  cblas_ztrsm(CblasColMajor, side, CblasLower, adjoint ? CblasConjTrans : CblasNoTrans, CblasNonUnit, m, n,
              &one, l, ldl, b, ldb);
}

/// c -= op_a(a) op_b(b), where an operation is to take the adjoint or nothing.
void subtract_product(bool adjoint_a, bool adjoint_b, int m, int n, int k, const double* a, int lda,
                      const double* b, int ldb, double* c, int ldc) {
  cblas_dgemm(CblasColMajor, adjoint_a ? CblasTrans : CblasNoTrans, adjoint_b ? CblasTrans : CblasNoTrans, m,
              n, k, -1, a, lda, b, ldb, 1, c, ldc);
}
void subtract_product(bool adjoint_a, bool adjoint_b, int m, int n, int k, const Complex* a, int lda,
                      const Complex* b, int ldb, Complex* c, int ldc) {
  const Complex one = 1, minus_one = -1;
  // With three products of real numbers in place of four.
  cblas_zgemm3m(CblasColMajor, adjoint_a ? CblasConjTrans : CblasNoTrans,
                adjoint_b ? CblasConjTrans : CblasNoTrans, m, n, k, &minus_one, a, lda, b, ldb, &one, c, ldc);
}

/// c -= a a^H, the lower triangle.
void subtract_square(int n, int k, const double* a, int lda, double* c, int ldc) {
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, -1, a, lda, 1, c, ldc);
}
void subtract_square(int n, int k, const Complex* a, int lda, Complex* c, int ldc) {
  cblas_zherk(CblasColMajor, CblasLower, CblasNoTrans, n, k, -1, a, lda, 1, c, ldc);
}

}  // namespace

template <class Scalar>
std::optional<TwoBlockCholesky<Scalar>> TwoBlockCholesky<Scalar>::factor(PackedLower<Scalar> a) {
  const auto& panels = a.panels();
  for (auto own = panels.begin(); own != panels.end(); ++own) {
    Scalar* diagonal = &a(own->first, own->first);
    const int n = own->n_columns;
    if (cholesky(n, diagonal, own->stride) != 0) return std::nullopt;
    if (own->end() == a.size()) continue;
    solve_triangle(CblasRight, true, a.size() - own->end(), n, diagonal, own->stride, diagonal + n,
                   own->stride);
    parallel_for(static_cast<int>(panels.end() - own) - 1, [&](int k) {
      const auto later = own + 1 + k;
      const Scalar* factors = &a(later->first, own->first);
      const int columns = later->n_columns, below = a.size() - later->end();
      subtract_square(columns, n, factors, own->stride, &a(later->first, later->first), later->stride);
      if (below > 0)
        subtract_product(false, true, below, columns, n, factors + columns, own->stride, factors, own->stride,
                         &a(later->end(), later->first), later->stride);
    });
  }
  return TwoBlockCholesky(std::move(a));
}

template <class Scalar>
void TwoBlockCholesky<Scalar>::forward(const Panel& panel, int first_row, DenseMatrix<Scalar>& x) const {
  const int rhs = x.columns(), n = panel.n_columns, below = l_.size() - panel.end();
  Scalar* own = x.data() + (panel.first - first_row);
  solve_triangle(CblasLeft, false, n, rhs, diagonal(panel), panel.stride, own, x.rows());
  if (below > 0)
    subtract_product(false, false, below, rhs, n, diagonal(panel) + n, panel.stride, own, x.rows(), own + n,
                     x.rows());
}

template <class Scalar>
void TwoBlockCholesky<Scalar>::backward(const Panel& panel, int first_row, DenseMatrix<Scalar>& x) const {
  const int rhs = x.columns(), n = panel.n_columns, below = l_.size() - panel.end();
  Scalar* own = x.data() + (panel.first - first_row);
  if (below > 0)
    subtract_product(true, false, n, rhs, below, diagonal(panel) + n, panel.stride, own + n, x.rows(), own,
                     x.rows());
  solve_triangle(CblasLeft, true, n, rhs, diagonal(panel), panel.stride, own, x.rows());
}

template <class Scalar>
void TwoBlockCholesky<Scalar>::eliminate(DenseMatrix<Scalar>& loads) const {
  if (loads.columns() == 0) return;
  for (const Panel& panel : l_.panels())
    if (panel.first < l_.n_first()) forward(panel, 0, loads);
}

template <class Scalar>
void TwoBlockCholesky<Scalar>::solve_last(DenseMatrix<Scalar>& loads) const {
  if (loads.columns() == 0) return;
  for (const Panel& panel : l_.panels())
    if (panel.first >= l_.n_first()) forward(panel, l_.n_first(), loads);
  for (auto panel = l_.panels().rbegin(); panel != l_.panels().rend(); ++panel)
    if (panel->first >= l_.n_first()) backward(*panel, l_.n_first(), loads);
}

template <class Scalar>
DenseMatrix<Scalar> TwoBlockCholesky<Scalar>::last_inverse() const {
  const int first = l_.n_first(), n = l_.size() - first;
  auto inverse = DenseMatrix<Scalar>::unfilled(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) inverse(i, j) = l_(first + i, first + j);
  invert(n, inverse.data());
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) inverse(j, i) = conjugate(inverse(i, j));
  return inverse;
}

template <class Scalar>
void TwoBlockCholesky<Scalar>::substitute(DenseMatrix<Scalar>& x) const {
  if (x.columns() == 0) return;
  for (auto panel = l_.panels().rbegin(); panel != l_.panels().rend(); ++panel)
    if (panel->first < l_.n_first()) backward(*panel, 0, x);
}

template class TwoBlockCholesky<double>;
template class TwoBlockCholesky<std::complex<double>>;

}  // namespace wheelwright
