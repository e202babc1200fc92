#include "wheelwright/linalg/sparse_spd.h"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <new>

namespace wheelwright {

struct SparseSpd::Factor {
  cholmod_common common;
  cholmod_factor* factor = nullptr;

  Factor() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
};

namespace {

cholmod_sparse* assemble(int size, std::span<const SparseSpd::Entry> entries, cholmod_common* common) {
  constexpr int lower_only = -1;
  cholmod_triplet* triplets =
      cholmod_allocate_triplet(size, size, entries.size(), lower_only, CHOLMOD_REAL, common);
  if (!triplets) throw std::bad_alloc();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    assert(entries[k].row >= entries[k].column);
    static_cast<int*>(triplets->i)[k] = entries[k].row;
    static_cast<int*>(triplets->j)[k] = entries[k].column;
    static_cast<double*>(triplets->x)[k] = entries[k].value;
  }
  triplets->nnz = entries.size();
  cholmod_sparse* matrix = cholmod_triplet_to_sparse(triplets, entries.size(), common);
  cholmod_free_triplet(&triplets, common);
  if (!matrix) throw std::bad_alloc();
  return matrix;
}

}  // namespace

Expected<SparseSpd> SparseSpd::factor(int size, std::span<const Entry> lower_triangle) {
  auto result = std::make_unique<Factor>();
  cholmod_common* common = &result->common;
  cholmod_sparse* matrix = assemble(size, lower_triangle, common);
  result->factor = cholmod_analyze(matrix, common);
  if (result->factor) cholmod_factorize(matrix, result->factor, common);
  cholmod_free_sparse(&matrix, common);
  if (common->status < CHOLMOD_OK || !result->factor) throw std::bad_alloc();
  if (const auto minor = result->factor->minor; minor < static_cast<std::size_t>(size))
    return Failure{FailureReason::not_positive_definite,
                   fmt::format("pivot {} of {} is not positive", minor, size)};
  return SparseSpd(std::move(result));
}

std::vector<double> SparseSpd::solve(std::span<const double> right_hand_side) const {
  const std::size_t n = factor_->factor->n;
  assert(right_hand_side.size() == n);
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = n;
  b.ncol = 1;
  b.x = const_cast<double*>(right_hand_side.data());
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_->factor, &b, &factor_->common);
  if (!x) throw std::bad_alloc();
  const double* values = static_cast<const double*>(x->x);
  std::vector<double> result(values, values + n);
  cholmod_free_dense(&x, &factor_->common);
  return result;
}

SparseSpd::SparseSpd(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
SparseSpd::SparseSpd(SparseSpd&&) noexcept = default;
SparseSpd& SparseSpd::operator=(SparseSpd&&) noexcept = default;
SparseSpd::~SparseSpd() = default;

}  // namespace wheelwright
