#include "linalg/partial_cholesky.h"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

extern "C" {
void dtrmm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
}

namespace wheelwright {

struct PartialCholesky::Factor {
  cholmod_common common;
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
  return PartialCholesky(std::move(f), std::move(schur));
}

/// The interior columns of a supernode: L's diagonal block and the rows below it.
struct PartialCholesky::Supernode {
  int first, n_columns;  ///< unknowns
  const int* below;      ///< unknowns of the rows below
  int n_below;
  const double* values;  ///< column-major, the diagonal block on top
  int stride;            ///< between columns
};

PartialCholesky::Supernode PartialCholesky::supernode(int s) const {
  const cholmod_factor& factor = *factor_->factor;
  const int* super = static_cast<const int*>(factor.super);
  const int* row_start = static_cast<const int*>(factor.pi);
  const int n_rows = row_start[s + 1] - row_start[s];
  const int n_columns = std::max(0, std::min(super[s + 1], n_interior()) - super[s]);
  return {super[s],
          n_columns,
          static_cast<const int*>(factor.s) + row_start[s] + n_columns,
          n_rows - n_columns,
          static_cast<const double*>(factor.x) + static_cast<const int*>(factor.px)[s],
          n_rows};
}

PartialCholesky::PartialCholesky(std::unique_ptr<Factor> factor, Matrix schur)
    : factor_(std::move(factor)), schur_(std::move(schur)), supernode_of_(factor_->factor->n) {
  const int* super = static_cast<const int*>(factor_->factor->super);
  for (int s = 0; s < static_cast<int>(factor_->factor->nsuper); ++s) {
    std::fill(supernode_of_.begin() + super[s], supernode_of_.begin() + super[s + 1], s);
    largest_supernode_ = std::max(largest_supernode_, supernode(s).stride);
  }
}
PartialCholesky::PartialCholesky(PartialCholesky&&) noexcept = default;
PartialCholesky& PartialCholesky::operator=(PartialCholesky&&) noexcept = default;
PartialCholesky::~PartialCholesky() = default;

double PartialCholesky::factor_entries() const { return static_cast<double>(factor_->factor->xsize); }
double PartialCholesky::factor_flops() const { return factor_->flops; }

PartialCholesky::Sweep PartialCholesky::sweep_through(const std::vector<char>& marked) const {
  const int n_supernodes = static_cast<int>(factor_->factor->nsuper);
  std::vector<char> needed(n_supernodes, 0);
  for (int i = 0; i < n_interior(); ++i)
    if (marked[i]) needed[supernode_of_[i]] = 1;
  Sweep sweep{{}, std::vector<char>(size(), 0)};
  std::fill(sweep.visited.begin() + n_interior(), sweep.visited.end(), 1);
  for (int s = 0; s < n_supernodes; ++s) {
    if (!needed[s]) continue;
    const Supernode node = supernode(s);
    sweep.supernodes.push_back(s);
    std::fill_n(sweep.visited.begin() + node.first, node.n_columns, 1);
    if (node.n_below > 0 && node.below[0] < n_interior()) needed[supernode_of_[node.below[0]]] = 1;
  }
  return sweep;
}

PartialCholesky::Sweep PartialCholesky::full_sweep() const {
  return sweep_through(std::vector<char>(size(), 1));
}

void PartialCholesky::eliminate(const Sweep& sweep, Matrix& loads) const {
  const int n = loads.rows();
  if (n == 0) return;
  const double one = 1, zero = 0;
  std::vector<double> passed_on(size_t(n) * largest_supernode_);
  for (const int s : sweep.supernodes) {
    const Supernode node = supernode(s);
    double* own = loads.column(node.first);
    dtrsm_("R", "L", "T", "N", &n, &node.n_columns, &one, node.values, &node.stride, own, &n);
    if (node.n_below == 0) continue;
    dgemm_("N", "T", &n, &node.n_below, &node.n_columns, &one, own, &n, node.values + node.n_columns,
           &node.stride, &zero, passed_on.data(), &n);
    for (int k = 0; k < node.n_below; ++k) {
      double* to = loads.column(node.below[k]);
      const double* from = &passed_on[size_t(k) * n];
      for (int i = 0; i < n; ++i) to[i] -= from[i];
    }
  }
}

void PartialCholesky::substitute(const Sweep& sweep, Matrix& x) const {
  const int n = x.rows();
  if (n == 0) return;
  const double one = 1, minus_one = -1;
  std::vector<double> known(size_t(n) * largest_supernode_);
  for (auto s = sweep.supernodes.rbegin(); s != sweep.supernodes.rend(); ++s) {
    const Supernode node = supernode(*s);
    double* own = x.column(node.first);
    for (int k = 0; k < node.n_below; ++k) std::copy_n(x.column(node.below[k]), n, &known[size_t(k) * n]);
    if (node.n_below > 0)
      dgemm_("N", "N", &n, &node.n_columns, &node.n_below, &minus_one, known.data(), &n,
             node.values + node.n_columns, &node.stride, &one, own, &n);
    dtrsm_("R", "L", "N", "N", &n, &node.n_columns, &one, node.values, &node.stride, own, &n);
  }
}

}  // namespace wheelwright
