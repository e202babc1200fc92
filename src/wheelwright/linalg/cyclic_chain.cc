#include "wheelwright/linalg/cyclic_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

Matrix identity(int n) {
  Matrix one(n, n);
  for (int i = 0; i < n; ++i) one(i, i) = 1;
  return one;
}

Failure not_positive_definite() {
  return {FailureReason::not_positive_definite,
          "a chain of equal links is not positive definite up to rounding, which cells far thinner than high "
          "magnify"};
}

/// Limit on the number of pivots. The pivots converge like the square of the spectral radius of step, so that
/// a chain that needs more is numerically singular.
constexpr int max_pivots = 10000;

/// A change of the pivot below this fraction of the diagonal is rounding once the changes no longer decrease.
constexpr double nearly_converged = 1e-12;

/// So is a change below this one, in badly conditioned links such as thin sheets, once this many changes were
/// not the smallest so far. The changes of a singular chain decrease to the end.
constexpr double badly_conditioned = 1e-8;
constexpr int max_stalls = 10;

/// Powers of step whose entries are all below this bound are neglected.
constexpr double negligible = 1e-17;

}  // namespace

Expected<CyclicChain> CyclicChain::factor(const Matrix& diagonal, const Matrix& next, int n_links) {
  const int n = diagonal.rows();
  CyclicChain chain;
  chain.n_links_ = n_links;
  Matrix pivot = diagonal, pivot_factor, coupling;
  const double largest = largest_entry(diagonal);
  double last_change = std::numeric_limits<double>::infinity(), min_change = last_change;
  int stalls = 0;
  for (int k = 0;; ++k) {
    pivot_factor = pivot;
    if (k == max_pivots || !cholesky(pivot_factor)) return not_positive_definite();
    coupling = next;
    cholesky_solve(pivot_factor, coupling);
    Matrix following = diagonal;
    multiply(-1, next, Op::transpose, coupling, Op::none, 1, following);
    double change = 0;
    for (size_t i = 0; i < pivot.entries().size(); ++i)
      change = std::max(change, std::abs(following.entries()[i] - pivot.entries()[i]));
    if (change >= min_change) ++stalls;
    if (change >= last_change && change <= nearly_converged * largest) break;
    if (stalls >= max_stalls && change <= badly_conditioned * largest) break;
    last_change = change;
    min_change = std::min(min_change, change);
    pivot = std::move(following);
  }
  chain.inverse_pivot_ = identity(n);
  cholesky_solve(pivot_factor, chain.inverse_pivot_);
  chain.step_ = Matrix(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) chain.step_(i, j) = -coupling(j, i);

  Matrix power = identity(n), closing = identity(n);
  for (int c = 0; c < n_links; ++c) {
    if (largest_entry(power) > negligible) chain.memory_ = c + 1;
    power = product(chain.step_, Op::none, power, Op::none);
  }
  for (size_t i = 0; i < power.entries().size(); ++i) closing.entries()[i] -= power.entries()[i];
  chain.closing_ = identity(n);
  if (!lu_solve(closing, chain.closing_)) return not_positive_definite();
  return chain;
}

Matrix CyclicChain::solve(const Matrix& loads) const {
  constexpr int together = 32;
  const int n_rhs = loads.columns() / n_links_;
  auto x = Matrix::unfilled(loads.rows(), loads.columns());
  parallel_for((n_rhs + together - 1) / together, [&](int group) {
    const int first = group * together;
    solve_some(loads, first, std::min(together, n_rhs - first), x);
  });
  return x;
}

/// Solves for the right-hand sides first ... first + n_rhs - 1.
void CyclicChain::solve_some(const Matrix& loads, int first, int n_rhs, Matrix& result) const {
  const int n = loads.rows();
  const auto copy = [&](const Matrix& from, auto place_from, Matrix& to, auto place_to) {
    for (int rhs = 0; rhs < n_rhs; ++rhs)
      for (int c = 0; c < n_links_; ++c)
        std::copy_n(from.column(place_from(rhs, c)), n, to.column(place_to(rhs, c)));
  };
  const auto by_rhs = [&](int rhs, int c) { return (first + rhs) * n_links_ + c; };
  const auto by_link = [&](int rhs, int c) { return c * n_rhs + rhs; };
  auto x = Matrix::unfilled(n, n_rhs * n_links_);
  copy(loads, by_rhs, x, by_link);
  const auto link = [&](int c) { return x.column(c * n_rhs); };

  // Forward elimination that ignores the predecessor of the first link; then the contribution of that
  // predecessor, propagated around the ring.
  Matrix passed(n, n_rhs), closed(n, n_rhs);
  for (int c = 1; c < n_links_; ++c) multiply_columns(1, step_, Op::none, link(c - 1), n_rhs, 1, link(c));
  multiply_columns(1, closing_, Op::none, link(n_links_ - 1), n_rhs, 0, passed.data());
  for (int c = 0; c < memory_; ++c) {
    multiply_columns(1, step_, Op::none, passed.data(), n_rhs, 0, closed.data());
    std::swap(passed, closed);
    std::transform(passed.data(), passed.data() + passed.entries().size(), link(c), link(c), std::plus());
  }
  x = product(inverse_pivot_, Op::none, x, Op::none);
  for (int c = n_links_ - 1; c > 0; --c)
    multiply_columns(1, step_, Op::transpose, link(c), n_rhs, 1, link(c - 1));
  multiply_columns(1, closing_, Op::transpose, link(0), n_rhs, 0, passed.data());
  for (int c = n_links_ - 1; c >= n_links_ - memory_; --c) {
    multiply_columns(1, step_, Op::transpose, passed.data(), n_rhs, 0, closed.data());
    std::swap(passed, closed);
    std::transform(passed.data(), passed.data() + passed.entries().size(), link(c), link(c), std::plus());
  }
  copy(x, by_link, result, by_rhs);
}

}  // namespace wheelwright
