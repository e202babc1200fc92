#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Equations of a closed chain of equal links, each coupled to its two neighbours:
///   next^T x_(c-1) + diagonal x_c + next x_(c+1) = f_c,   c modulo n_links.
/// Solved by block elimination along the chain, with the pivots of an endless one, and a small system that
/// closes it.
class CyclicChain {
 public:
  /// Fails with not_positive_definite when an endless chain of such links is not.
  static Expected<CyclicChain> factor(const Matrix& diagonal, const Matrix& next, int n_links);

  int n_links() const { return n_links_; }

  /// One column for every (right-hand side, link): column = rhs * n_links + link.
  Matrix solve(const Matrix& loads) const;

 private:
  CyclicChain() = default;
  void solve_some(const Matrix& loads, int first, int n_rhs, Matrix& result) const;

  int n_links_ = 0;
  Matrix pivot_factor_;  ///< Cholesky's of the pivot X = diagonal - next^T X^-1 next
  Matrix step_;          ///< -next^T X^-1: what a link's load passes on to the next one
  Matrix closing_;       ///< (1 - step^n_links)^-1
  int memory_ = 0;       ///< links after which step's powers vanish to rounding
};

}  // namespace wheelwright
