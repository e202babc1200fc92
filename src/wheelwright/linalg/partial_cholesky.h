#pragma once

#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/linalg/sparse_symmetric.h"

namespace wheelwright {

/// Static condensation of a sparse symmetric matrix onto its trailing unknowns t, by multifrontal Cholesky
/// factorization of the interior ones i: schur = K_tt - K_ti K_ii^-1 K_it. K_ii must be positive definite;
/// K_tt need not be (empty rows are fine). Supernodes come from CHOLMOD's symbolic analysis; the numbers are
/// the program's own, so that subtrees go to several threads and nothing is spent on factoring K_tt.
/// "Elimination order" has the interior unknowns first, the trailing ones last. Vectors are matrices with one
/// row a vector and one column an unknown in elimination order, so that sweeps move contiguous numbers.
class PartialCholesky {
 public:
  /// The unknowns of node i are block * i ... block * i + block - 1, and couple with all of another node's or
  /// with none. `order[k]` is the node eliminated k-th; its last n_trailing ones are the trailing nodes, in
  /// the order that schur() keeps. Fails with not_positive_definite or not_finite.
  static Expected<PartialCholesky> factor(const SparseSymmetric& matrix, int block,
                                          std::span<const int> order, int n_trailing);

  int size() const { return static_cast<int>(supernode_of_.size()); }
  int n_trailing() const { return schur_.rows(); }
  int n_interior() const { return size() - n_trailing(); }
  const Matrix& schur() const { return schur_; }  ///< full symmetric
  double factor_flops() const;                    ///< of the numerical factorization

  /// What sweeps visit of the factor: supernodes, ascending, each with all that it depends on.
  struct Sweep {
    std::vector<int> supernodes;
    std::vector<char> visited;  ///< of every unknown; trailing ones always are
  };
  /// The least sweep that visits the unknowns with a mark (one mark an unknown in elimination order).
  Sweep sweep_through(const std::vector<char>& marked) const;
  Sweep full_sweep() const;
  double sweep_entries(const Sweep& sweep) const;  ///< numbers of the factor that it visits

  /// Forward elimination of loads f in place: the interior unknowns become L_ii^-1 f_i, the trailing ones the
  /// condensed loads f_t - K_ti K_ii^-1 f_i. Loads on unknowns that the sweep does not visit must be zero.
  void eliminate(const Sweep& sweep, Matrix& loads) const;

  /// Back substitution in place: takes what eliminate() makes of the interior loads (zero without any) and
  /// the trailing displacements; the interior unknowns that the sweep visits become displacements.
  void substitute(const Sweep& sweep, Matrix& x) const;

 private:
  /// Interior unknowns eliminated together: L's diagonal block and the rows below it.
  struct Supernode {
    int first, n_columns;  ///< unknowns
    int n_below;
    size_t below;   ///< where the unknowns of the rows below start in below_
    size_t values;  ///< where L's columns start in values_: column-major, the diagonal block on top
    int parent;     ///< of the elimination tree; -1 when all rows below are trailing ones
    int stride() const { return n_columns + n_below; }
  };
  class Numbers;

  PartialCholesky() = default;
  static Expected<PartialCholesky> analyze(const SparseSymmetric& matrix, int block,
                                           std::span<const int> order, int n_trailing);

  std::vector<Supernode> supernodes_;  ///< children before parents
  std::vector<int> supernode_of_;      ///< of every unknown; -1 for trailing ones
  std::vector<int> below_;
  std::vector<double> values_;
  Matrix schur_;
};

}  // namespace wheelwright
