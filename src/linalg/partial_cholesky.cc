#include "linalg/partial_cholesky.h"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

extern "C" void dtrmm_(const char*, const char*, const char*, const char*, const int*, const int*,
                       const double*, const double*, const int*, double*, const int*);

namespace wheelwright {

struct PartialCholesky::Factor {
  mutable cholmod_common common;
  cholmod_factor* factor = nullptr;
  double flops = 0;

  Factor() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = true;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = false;
    common.print = 0;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

namespace {

/// Columns first_column.. of a supernodal factor, as a dense lower triangle.
Matrix trailing_block(const cholmod_factor& factor, int first_column) {
  const int n = static_cast<int>(factor.n);
  Matrix block(n - first_column, n - first_column);
  const int* super = static_cast<const int*>(factor.super);
  const int* row_start = static_cast<const int*>(factor.pi);
  const int* value_start = static_cast<const int*>(factor.px);
  const int* row = static_cast<const int*>(factor.s);
  const double* values = static_cast<const double*>(factor.x);
  for (size_t s = 0; s < factor.nsuper; ++s) {
    const int n_rows = row_start[s + 1] - row_start[s];
    for (int j = std::max(super[s], first_column); j < super[s + 1]; ++j) {
      const int local = j - super[s];
      const double* column = values + value_start[s] + size_t(local) * n_rows;
      for (int r = local; r < n_rows; ++r)
        block(row[row_start[s] + r] - first_column, j - first_column) = column[r];
    }
  }
  return block;
}

/// l l^T - shift on the diagonal, full symmetric.
Matrix schur_complement(const Matrix& l, double shift) {
  const int n = l.rows();
  Matrix s = l;
  const double one = 1;
  if (n > 0) dtrmm_("R", "L", "T", "N", &n, &n, &one, l.data(), &n, s.data(), &n);
  for (int j = 0; j < n; ++j) {
    s(j, j) -= shift;
    for (int i = 0; i < j; ++i) s(i, j) = s(j, i);
  }
  return s;
}

}  // namespace

Expected<PartialCholesky> PartialCholesky::factor(const SparseSymmetric& matrix, std::span<const int> order,
                                                  int n_trailing) {
  const int n = matrix.size;
  // Trailing rows may be empty before the neighbouring sectors add theirs: shift them here, subtract below.
  double shift = 0;
  for (int j = 0; j < n; ++j) shift = std::max(shift, matrix.values[matrix.column_start[j]]);
  std::vector<double> values = matrix.values;
  for (int k = n - n_trailing; k < n; ++k) values[matrix.column_start[order[k]]] += shift;

  cholmod_sparse a{};
  a.nrow = a.ncol = n;
  a.nzmax = matrix.rows.size();
  a.p = const_cast<int*>(matrix.column_start.data());
  a.i = const_cast<int*>(matrix.rows.data());
  a.x = values.data();
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = true;

  auto f = std::make_unique<Factor>();
  f->factor = cholmod_analyze_p(&a, const_cast<int*>(order.data()), nullptr, 0, &f->common);
  if (!f->factor || !std::equal(order.begin(), order.end(), static_cast<const int*>(f->factor->Perm)))
    return Failure{FailureReason::not_positive_definite, "CHOLMOD did not keep the elimination order"};
  f->flops = f->common.fl;
  cholmod_factorize(&a, f->factor, &f->common);
  if (f->common.status != CHOLMOD_OK || f->factor->minor < f->factor->n || !f->factor->is_super)
    return Failure{FailureReason::not_positive_definite,
                   fmt::format("the stiffness of a sector is not positive definite at unknown {} of {}",
                               f->factor->minor, n)};
  Matrix l = trailing_block(*f->factor, n - n_trailing);
  Matrix schur = schur_complement(l, shift);
  for (double x : schur.entries())
    if (!std::isfinite(x)) return Failure{FailureReason::not_finite, "the condensed stiffness is not finite"};
  return PartialCholesky(std::move(f), std::move(schur), std::move(l));
}

PartialCholesky::PartialCholesky(std::unique_ptr<Factor> factor, Matrix schur, Matrix trailing_factor)
    : factor_(std::move(factor)), schur_(std::move(schur)), trailing_factor_(std::move(trailing_factor)) {}
PartialCholesky::PartialCholesky(PartialCholesky&&) noexcept = default;
PartialCholesky& PartialCholesky::operator=(PartialCholesky&&) noexcept = default;
PartialCholesky::~PartialCholesky() = default;

int PartialCholesky::size() const { return static_cast<int>(factor_->factor->n); }
double PartialCholesky::factor_entries() const { return static_cast<double>(factor_->factor->xsize); }
double PartialCholesky::factor_flops() const { return factor_->flops; }

namespace {

cholmod_dense view(Matrix& x) {
  cholmod_dense d{};
  d.nrow = d.d = x.rows();
  d.ncol = x.columns();
  d.nzmax = d.nrow * d.ncol;
  d.x = x.data();
  d.xtype = CHOLMOD_REAL;
  d.dtype = CHOLMOD_DOUBLE;
  return d;
}

cholmod_dense view_workspace(Matrix& workspace) {
  cholmod_dense d = view(workspace);
  d.d = d.nrow = std::max<size_t>(1, d.nrow);
  return d;
}

}  // namespace

/// x_t <- L_tt x_t or L_tt^T x_t.
void PartialCholesky::apply_trailing(Op op, Matrix& x) const {
  const int m = n_trailing(), columns = x.columns(), leading = x.rows();
  if (m == 0 || columns == 0) return;
  const double one = 1;
  dtrmm_("L", "L", op == Op::none ? "N" : "T", "N", &m, &columns, &one, trailing_factor_.data(), &m,
         x.data() + (size() - m), &leading);
}

void PartialCholesky::eliminate(Matrix& loads) const {
  Matrix workspace(loads.columns(), static_cast<int>(factor_->factor->maxesize));
  cholmod_dense x = view(loads), e = view_workspace(workspace);
  cholmod_super_lsolve(factor_->factor, &x, &e, &factor_->common);
  apply_trailing(Op::none, loads);
}

void PartialCholesky::substitute(Matrix& x) const {
  apply_trailing(Op::transpose, x);
  Matrix workspace(x.columns(), static_cast<int>(factor_->factor->maxesize));
  cholmod_dense d = view(x), e = view_workspace(workspace);
  cholmod_super_ltsolve(factor_->factor, &d, &e, &factor_->common);
}

}  // namespace wheelwright
