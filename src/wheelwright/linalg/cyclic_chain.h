#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Solves the block-cyclic equations of a closed chain of equal links, each coupled to its two neighbours:
///   next^T x_(c-1) + diagonal x_c + next x_(c+1) = f_c,   c modulo n_links.
/// The method is block elimination along the chain with the pivots of an infinite chain, and a small system
/// that closes the ring.
class CyclicChain {
 public:
  /// Fails with not_positive_definite when the operator of an infinite chain of such links is not positive
  /// definite.
  static Expected<CyclicChain> factor(const Matrix& diagonal, const Matrix& next, int n_links);

  int n_links() const { return n_links_; }

  /// Loads and solution have one column per right-hand side and link: column = rhs * n_links + link.
  Matrix solve(const Matrix& loads) const;

 private:
  CyclicChain() = default;
  void solve_some(const Matrix& loads, int first, int n_rhs, Matrix& result) const;

  int n_links_ = 0;
  Matrix inverse_pivot_;  ///< X^-1 of the pivot X = diagonal - next^T X^-1 next
  Matrix step_;           ///< -next^T X^-1: propagates the load of a link to the next link
  Matrix closing_;        ///< (1 - step^n_links)^-1
  int memory_ = 0;        ///< number of links after which the powers of step vanish to rounding
};

}  // namespace wheelwright
