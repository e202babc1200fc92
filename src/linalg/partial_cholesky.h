#pragma once

#include <memory>
#include <span>

#include "base/expected.h"
#include "linalg/dense.h"
#include "linalg/sparse_symmetric.h"

namespace wheelwright {

/// Static condensation of a sparse symmetric matrix onto its trailing unknowns t, by one supernodal Cholesky
/// factorization (CHOLMOD) of the whole: with i the interior unknowns, schur = K_tt - K_ti K_ii^-1 K_it.
/// K_ii must be positive definite; K_tt need not be (empty rows are fine).
/// "Elimination order" has the interior unknowns first, the trailing ones last. Vectors are matrices with one
/// row a vector and one column an unknown in elimination order, so that sweeps move contiguous numbers.
class PartialCholesky {
 public:
  /// `order[k]` is the unknown eliminated k-th; its last n_trailing ones are the trailing unknowns, in the
  /// order that schur() keeps. Fails with not_positive_definite.
  static Expected<PartialCholesky> factor(const SparseSymmetric& matrix, std::span<const int> order,
                                          int n_trailing);

  int size() const { return static_cast<int>(supernode_of_.size()); }
  int n_trailing() const { return schur_.rows(); }
  int n_interior() const { return size() - n_trailing(); }
  const Matrix& schur() const { return schur_; }  ///< full symmetric
  double factor_entries() const;                  ///< nonzeros of the factor
  double factor_flops() const;                    ///< of the numerical factorization

  /// What sweeps visit of the factor: supernodes, ascending, each with all that it depends on.
  struct Sweep {
    std::vector<int> supernodes;
    std::vector<char> visited;  ///< of every unknown; trailing ones always are
  };
  /// The least sweep that visits the unknowns with a mark (one mark an unknown in elimination order).
  Sweep sweep_through(const std::vector<char>& marked) const;
  Sweep full_sweep() const;

  /// Forward elimination of loads f in place: the interior unknowns become L_ii^-1 f_i, the trailing ones the
  /// condensed loads f_t - K_ti K_ii^-1 f_i. Loads on unknowns that the sweep does not visit must be zero.
  void eliminate(const Sweep& sweep, Matrix& loads) const;

  /// Back substitution in place: takes what eliminate() makes of the interior loads (zero without any) and
  /// the trailing displacements; the interior unknowns that the sweep visits become displacements.
  void substitute(const Sweep& sweep, Matrix& x) const;

  PartialCholesky(PartialCholesky&&) noexcept;
  PartialCholesky& operator=(PartialCholesky&&) noexcept;
  ~PartialCholesky();

 private:
  struct Factor;
  struct Supernode;
  PartialCholesky(std::unique_ptr<Factor> factor, Matrix schur);
  Supernode supernode(int s) const;

  std::unique_ptr<Factor> factor_;
  Matrix schur_;
  std::vector<int> supernode_of_;  ///< of every unknown
  int largest_supernode_ = 0;      ///< rows
};

}  // namespace wheelwright
