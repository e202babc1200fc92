#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/linalg/sparse_symmetric.h"

namespace wheelwright {

/// Static condensation of a sparse symmetric matrix onto its trailing unknowns t, by multifrontal Cholesky
/// factorization of its interior unknowns i: schur = K_tt - K_ti K_ii^-1 K_it. K_ii must be positive
/// definite; K_tt need not be (empty rows are allowed). CHOLMOD's symbolic analysis finds the supernodes. The
/// numerical factorization is our own: it shares subtrees among threads and does not factor K_tt. In
/// elimination order the interior unknowns come first and the trailing unknowns last. A set of vectors is a
/// matrix with one row per vector and one column per unknown in elimination order, so that sweeps access
/// contiguous memory.
class PartialCholesky {
 public:
  /// The unknowns of node i are block * i ... block * i + block - 1; they couple with all unknowns of another
  /// node or with none of them. `order[k]` is the node that is eliminated k-th. The last n_trailing nodes of
  /// `order` are the trailing nodes; schur() keeps their order. Fails with not_positive_definite or
  /// not_finite.
  static Expected<PartialCholesky> factor(const SparseSymmetric& matrix, int block,
                                          std::span<const int> order, int n_trailing);

  /// The symbolic analysis, which matrices of one pattern share.
  class Analysis;
  static Expected<std::shared_ptr<const Analysis>> analyze(const SparseSymmetric& matrix, int block,
                                                           std::span<const int> order, int n_trailing);
  /// The same as above; the pattern of `matrix` must be the analyzed one.
  static Expected<PartialCholesky> factor(const SparseSymmetric& matrix,
                                          std::shared_ptr<const Analysis> analysis);

  /// Without interior unknowns, and without schur(), which is then the matrix itself.
  static PartialCholesky without_interior(int n_trailing);

  int size() const;
  int n_trailing() const;
  int n_interior() const { return size() - n_trailing(); }
  const Matrix& schur() const { return schur_; }  ///< both triangles; empty once it is released
  Matrix release_schur() { return std::exchange(schur_, {}); }
  double factor_flops() const;  ///< flops of the numerical factorization
  /// The flops that must follow each other on one thread, however many threads there are: those of the
  /// supernodes on the most expensive path of the elimination tree, and of the small subtree where it begins.
  double longest_chain_flops() const;

  /// The part of the factor that a sweep visits: ascending supernodes, each with all supernodes that it
  /// depends on.
  struct Sweep {
    std::vector<int> supernodes;
    std::vector<char> visited;  ///< one flag per unknown; always true for trailing unknowns
  };
  /// The smallest sweep that visits all marked unknowns (one mark per unknown, in elimination order).
  Sweep sweep_through(const std::vector<char>& marked) const;
  Sweep full_sweep() const;
  double sweep_entries(const Sweep& sweep) const;  ///< number of factor entries that the sweep visits

  /// Forward elimination of loads f in place: the interior loads become L_ii^-1 f_i, the trailing loads
  /// become the condensed loads f_t - K_ti K_ii^-1 f_i. Loads on unknowns that the sweep does not visit must
  /// be zero.
  void eliminate(const Sweep& sweep, Matrix& loads) const;

  /// Back substitution in place. On entry the interior part holds the result of eliminate() (zero without
  /// interior loads) and the trailing part holds displacements; on return the interior unknowns that the
  /// sweep visits hold displacements too.
  void substitute(const Sweep& sweep, Matrix& x) const;

 private:
  /// Interior unknowns that are eliminated together: a diagonal block of L and the rows below it.
  struct Supernode {
    int first, n_columns;  ///< its unknowns are first ... first + n_columns - 1
    int n_below;           ///< number of rows of L below the diagonal block
    size_t below;          ///< start of the unknowns of the rows below in below_
    size_t values;         ///< start of the columns of L in values_: column-major, diagonal block on top
    int parent;            ///< in the elimination tree; -1 when all rows below belong to trailing unknowns
    int stride() const { return n_columns + n_below; }
    double flops() const;                                                    ///< of its elimination
    double work() const { return double(n_columns) * stride() * stride(); }  ///< about its time
  };
  class Numbers;

  explicit PartialCholesky(std::shared_ptr<const Analysis> analysis);
  const std::vector<Supernode>& supernodes() const;
  /// The unknowns of the rows below the diagonal block of a supernode.
  const int* rows_below(const Supernode& node) const;
  /// The columns of L of a supernode; their stride is node.stride().
  const double* columns(const Supernode& node) const { return values_.data() + node.values; }

  std::shared_ptr<const Analysis> analysis_;
  Matrix::Entries values_;
  Matrix schur_;
};

class PartialCholesky::Analysis {
  friend class PartialCholesky;

  std::vector<Supernode> supernodes_;  ///< children before parents
  std::vector<int> supernode_of_;      ///< one entry per unknown; -1 for trailing unknowns
  std::vector<int> below_;
  std::vector<int> place_;  ///< the elimination index of every unknown of the matrix
  size_t n_values_ = 0;
  int n_trailing_ = 0;
};

inline int PartialCholesky::size() const { return static_cast<int>(analysis_->supernode_of_.size()); }
inline int PartialCholesky::n_trailing() const { return analysis_->n_trailing_; }
inline const std::vector<PartialCholesky::Supernode>& PartialCholesky::supernodes() const {
  return analysis_->supernodes_;
}
inline const int* PartialCholesky::rows_below(const Supernode& node) const {
  return analysis_->below_.data() + node.below;
}

}  // namespace wheelwright
