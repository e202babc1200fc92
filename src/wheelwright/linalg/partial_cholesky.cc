#include "wheelwright/linalg/partial_cholesky.h"

#include <cblas.h>
#include <cholmod.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <numeric>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

/// CHOLMOD's symbolic analysis of a node graph in a given order.
class SymbolicFactor {
 public:
  SymbolicFactor(const SparseSymmetric& matrix, int block, std::span<const int> order) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = false;
    common_.print = 0;
    for (size_t& columns : common_.nrelax) columns = std::max<size_t>(1, columns / block);

    std::vector<int> column_start{0}, rows;
    for (int node = 0; node < matrix.size / block; ++node) {
      for (int k = matrix.column_start[block * node]; k < matrix.column_start[block * node + 1]; ++k)
        if (const int row = matrix.rows[k] / block;
            static_cast<int>(rows.size()) == column_start.back() || rows.back() != row)
          rows.push_back(row);
      column_start.push_back(static_cast<int>(rows.size()));
    }
    cholmod_sparse graph{};
    graph.nrow = graph.ncol = order.size();
    graph.nzmax = rows.size();
    graph.p = column_start.data();
    graph.i = rows.data();
    graph.stype = -1;
    graph.itype = CHOLMOD_INT;
    graph.xtype = CHOLMOD_PATTERN;
    graph.sorted = graph.packed = true;
    factor_ = cholmod_analyze_p(&graph, const_cast<int*>(order.data()), nullptr, 0, &common_);
    if (factor_ && !std::equal(order.begin(), order.end(), static_cast<const int*>(factor_->Perm)))
      cholmod_free_factor(&factor_, &common_);
  }
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;
  ~SymbolicFactor() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  bool lacked_memory() const { return common_.status == CHOLMOD_OUT_OF_MEMORY; }
  bool kept_order() const { return factor_ != nullptr; }
  int n_supernodes() const { return static_cast<int>(factor_->nsuper); }
  int first(int supernode) const { return static_cast<const int*>(factor_->super)[supernode]; }
  /// Nodes of the rows of a supernode; the nodes of its diagonal block come first.
  std::span<const int> rows(int supernode) const {
    const int* start = static_cast<const int*>(factor_->pi);
    return {static_cast<const int*>(factor_->s) + start[supernode],
            size_t(start[supernode + 1] - start[supernode])};
  }

 private:
  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
};

/// Subtrees of the elimination tree with a smaller share of the work are eliminated by one thread.
constexpr double worth_sharing = 0.02;

/// Rows below the diagonal block of a large front that one thread does, and columns and rows of a tile of its
/// update: the same for any number of threads. Smaller ones would take more time on one thread.
constexpr int rows_together = 256, tile_rows = 1024;
constexpr double large_front = 3e8;  // flops

/// Calls f(j) for every column; many columns are shared among the threads.
template <class F>
void for_columns(int n, const F& f) {
  constexpr int together = 256;
  if (n <= together) {
    for (int j = 0; j < n; ++j) f(j);
    return;
  }
  parallel_for((n + together - 1) / together, [&](int k) {
    for (int j = k * together; j < std::min(n, (k + 1) * together); ++j) f(j);
  });
}

/// Whether the threads share a front with so many rows below its diagonal block.
bool is_shared(int n_below, double flops) { return n_below > rows_together && flops > large_front; }

/// The flops of a shared front that one thread does: its diagonal block, one block of rows and one tile.
double longest_chain_of_shared(double n_columns, double n_below) {
  const double n = n_columns, rows = std::min<double>(tile_rows, n_below);
  return n * n * n / 3 + rows_together * n * n + 2 * rows_together * rows * n;
}

/// Number of vectors that a sweep processes together.
constexpr int sweep_block = 24;

/// Calls f(first, n) for blocks of n of the `size` vectors. The blocks do not depend on the number of
/// threads.
void for_blocks(int size, const std::function<void(int, int)>& f) {
  const int n_blocks = (size + sweep_block - 1) / sweep_block;
  parallel_for(n_blocks, [&](int block) {
    const int first = size * block / n_blocks, last = size * (block + 1) / n_blocks;
    f(first, last - first);
  });
}

/// x = x op(l)^-1 for the n rows of x, of which few are solved one by one: dtrsm copies the triangle first.
void solve_rows(CBLAS_TRANSPOSE op, int n, int n_columns, const double* l, int stride, double* x,
                int leading) {
  constexpr int few = 4;
  if (n > few) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, op, CblasNonUnit, n, n_columns, 1, l, stride, x,
                leading);
    return;
  }
  for (int i = 0; i < n; ++i)
    cblas_dtrsv(CblasColMajor, CblasLower, op == CblasTrans ? CblasNoTrans : CblasTrans, CblasNonUnit,
                n_columns, l, stride, x + i, leading);
}

}  // namespace

Expected<std::shared_ptr<const PartialCholesky::Analysis>> PartialCholesky::analyze(
    const SparseSymmetric& matrix, int block, std::span<const int> order, int n_trailing) {
  const SymbolicFactor symbolic(matrix, block, order);
  if (symbolic.lacked_memory()) throw std::bad_alloc();
  if (!symbolic.kept_order())
    return Failure{FailureReason::not_positive_definite, "CHOLMOD did not keep the elimination order"};
  const int n_interior = static_cast<int>(order.size()) - n_trailing;
  auto result = std::make_shared<Analysis>();
  result->supernode_of_.assign(matrix.size, -1);
  result->n_trailing_ = block * n_trailing;
  for (int s = 0; s < symbolic.n_supernodes() && symbolic.first(s) < n_interior; ++s) {
    const auto rows = symbolic.rows(s);
    const auto below = std::upper_bound(
        rows.begin(), rows.end(),
        std::min(n_interior, s + 1 < symbolic.n_supernodes() ? symbolic.first(s + 1) : n_interior) - 1);
    const Supernode node{.first = block * symbolic.first(s),
                         .n_columns = block * static_cast<int>(below - rows.begin()),
                         .n_below = block * static_cast<int>(rows.end() - below),
                         .below = result->below_.size(),
                         .values = result->n_values_,
                         .parent = -1};
    for (auto row = below; row != rows.end(); ++row)
      for (int c = 0; c < block; ++c) result->below_.push_back(block * *row + c);
    result->n_values_ += size_t(node.stride()) * node.n_columns;
    std::fill_n(result->supernode_of_.begin() + node.first, node.n_columns, s);
    result->supernodes_.push_back(node);
  }
  for (Supernode& node : result->supernodes_)
    if (node.n_below > 0) node.parent = result->supernode_of_[result->below_[node.below]];
  result->place_.resize(matrix.size);
  for (size_t k = 0; k < order.size(); ++k)
    for (int c = 0; c < block; ++c) result->place_[block * order[k] + c] = block * static_cast<int>(k) + c;
  return std::shared_ptr<const Analysis>(std::move(result));
}

PartialCholesky::PartialCholesky(std::shared_ptr<const Analysis> analysis) : analysis_(std::move(analysis)) {}

PartialCholesky PartialCholesky::without_interior(int n_trailing) {
  auto analysis = std::make_shared<Analysis>();
  analysis->supernode_of_.assign(n_trailing, -1);
  analysis->n_trailing_ = n_trailing;
  return PartialCholesky(std::move(analysis));
}

/// The numerical factorization: fills values_ and schur_.
class PartialCholesky::Numbers {
 public:
  Numbers(PartialCholesky& factor, const SparseSymmetric& matrix)
      : factor_(factor),
        children_(factor.supernodes().size()),
        work_(factor.supernodes().size()),
        updates_(factor.supernodes().size()) {
    factor.values_.resize(factor.analysis_->n_values_);  // set by eliminate(), supernode by supernode
    factor.schur_ = Matrix(factor.n_trailing(), factor.n_trailing());
    for (size_t s = 0; s < children_.size(); ++s) {
      const Supernode& node = factor.supernodes()[s];
      work_[s] += node.work();
      (node.parent < 0 ? roots_ : children_[node.parent]).push_back(static_cast<int>(s));
      (node.parent < 0 ? total_work_ : work_[node.parent]) += work_[s];
    }
    sort_entries(matrix);
  }

  /// False when a supernode is not positive definite.
  bool eliminate() { return eliminate_in_parallel(roots_); }

  void finish_schur() {
    Matrix& schur = factor_.schur_;
    const int first = factor_.n_interior();
    for (int j = first; j < factor_.size(); ++j)
      for (int k = column_start_[j]; k < column_start_[j + 1]; ++k)
        schur(entries_[k].row - first, j - first) += entries_[k].value;
    for (size_t s = 0; s < updates_.size(); ++s) {
      const Supernode& node = factor_.supernodes()[s];
      if (node.parent >= 0) continue;
      const int* rows = factor_.rows_below(node);
      for_columns(node.n_below, [&](int j) {
        for (int i = j; i < node.n_below; ++i) schur(rows[i] - first, rows[j] - first) += updates_[s](i, j);
      });
    }
    for_columns(schur.columns(), [&](int j) {
      for (int i = 0; i < j; ++i) schur(i, j) = schur(j, i);
    });
  }

 private:
  struct Entry {
    int row;
    double value;
  };

  /// Sorts the lower triangle of the matrix into columns in elimination order.
  void sort_entries(const SparseSymmetric& matrix) {
    const std::vector<int>& place = factor_.analysis_->place_;
    if (std::ranges::is_sorted(place)) {
      column_start_ = matrix.column_start;
      entries_.reserve(matrix.rows.size());
      for (size_t k = 0; k < matrix.rows.size(); ++k) entries_.push_back({matrix.rows[k], matrix.values[k]});
      return;
    }
    column_start_.assign(matrix.size + 1, 0);
    for (int j = 0; j < matrix.size; ++j)
      for (int k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k)
        ++column_start_[std::min(place[j], place[matrix.rows[k]]) + 1];
    std::partial_sum(column_start_.begin(), column_start_.end(), column_start_.begin());
    entries_.resize(matrix.rows.size());
    std::vector<int> next(column_start_.begin(), column_start_.end() - 1);
    for (int j = 0; j < matrix.size; ++j)
      for (int k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k) {
        const auto [column, row] = std::minmax(place[j], place[matrix.rows[k]]);
        entries_[next[column]++] = {row, matrix.values[k]};
      }
  }

  bool eliminate_in_parallel(const std::vector<int>& subtrees) {
    std::vector<char> is_definite(subtrees.size());
    parallel_for(static_cast<int>(subtrees.size()), [&](int i) {
      const int s = subtrees[i];
      std::vector<int> place(factor_.size());
      is_definite[i] = work_[s] < worth_sharing * total_work_
                           ? eliminate_subtree(s, place)
                           : eliminate_in_parallel(children_[s]) && eliminate(s, place);
    });
    return std::all_of(is_definite.begin(), is_definite.end(), [](char d) { return d; });
  }

  bool eliminate_subtree(int root, std::vector<int>& place) {
    return std::all_of(children_[root].begin(), children_[root].end(),
                       [&](int child) { return eliminate_subtree(child, place); }) &&
           eliminate(root, place);
  }

  /// `place` is work space with one entry per unknown.
  bool eliminate(int s, std::vector<int>& place) {
    const Supernode& node = factor_.supernodes()[s];
    const int stride = node.stride(), n = node.n_columns, m = node.n_below;
    const int* below = factor_.rows_below(node);
    double* l = &factor_.values_[node.values];
    std::iota(place.begin() + node.first, place.begin() + node.first + n, 0);
    for (int k = 0; k < m; ++k) place[below[k]] = n + k;
    Matrix& update = updates_[s] = Matrix::unfilled(m, m);
    for_columns(n, [&](int j) { std::fill_n(l + size_t(j) * stride, stride, 0.0); });
    for_columns(m, [&](int j) { std::fill_n(update.column(j), m, 0.0); });

    for (int j = 0; j < n; ++j)
      for (int k = column_start_[node.first + j]; k < column_start_[node.first + j + 1]; ++k)
        l[size_t(j) * stride + place[entries_[k].row]] += entries_[k].value;
    for (const int child : children_[s]) {
      const int n_rows = factor_.supernodes()[child].n_below;
      const int* rows = factor_.rows_below(factor_.supernodes()[child]);
      for_columns(n_rows, [&](int j) {
        const int column = place[rows[j]];
        double* to = column < n ? l + size_t(column) * stride : update.column(column - n) - n;
        const double* from = updates_[child].column(j);
        for (int i = j; i < n_rows; ++i) to[place[rows[i]]] += from[i];
      });
      updates_[child] = {};
    }
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, l, stride) != 0) return false;
    if (m == 0) return true;
    if (is_shared(m, node.flops())) {
      eliminate_below_in_parallel(n, m, stride, l, update);
      return true;
    }
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1, l, stride, l + n,
                stride);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, m, n, -1, l + n, stride, 1, update.data(), m);
    return true;
  }

  /// The `m` rows below a factored diagonal block and their update, in tiles.
  static void eliminate_below_in_parallel(int n, int m, int stride, double* l, Matrix& update) {
    struct Tile {
      int column, n_columns, row, n_rows;
    };
    std::vector<Tile> tiles;
    for (int j = 0; j < m; j += rows_together) {
      const int columns = std::min(rows_together, m - j);
      tiles.push_back({j, columns, j, columns});
      for (int i = j + columns; i < m; i += tile_rows)
        tiles.push_back({j, columns, i, std::min(tile_rows, m - i)});
    }
    parallel_for((m + rows_together - 1) / rows_together, [&](int block) {
      const int first = block * rows_together;
      cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit,
                  std::min(rows_together, m - first), n, 1, l, stride, l + n + first, stride);
    });
    parallel_for(static_cast<int>(tiles.size()), [&](int k) {
      const Tile& tile = tiles[k];
      const double *rows = l + n + tile.row, *columns = l + n + tile.column;
      double* to = update.column(tile.column) + tile.row;
      if (tile.row == tile.column)
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, tile.n_rows, n, -1, rows, stride, 1, to, m);
      else
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, tile.n_rows, tile.n_columns, n, -1, rows, stride,
                    columns, stride, 1, to, m);
    });
  }

  PartialCholesky& factor_;
  std::vector<int> roots_;
  std::vector<std::vector<int>> children_;
  std::vector<double> work_;  ///< estimated work per subtree
  double total_work_ = 0;
  /// Update matrix that a supernode adds to its parent: lower triangle on its rows below.
  std::vector<Matrix> updates_;
  std::vector<int> column_start_;
  std::vector<Entry> entries_;
};

Expected<PartialCholesky> PartialCholesky::factor(const SparseSymmetric& matrix, int block,
                                                  std::span<const int> order, int n_trailing) {
  auto analysis = analyze(matrix, block, order, n_trailing);
  if (!analysis) return analysis.failure();
  return factor(matrix, *std::move(analysis));
}

Expected<PartialCholesky> PartialCholesky::factor(const SparseSymmetric& matrix,
                                                  std::shared_ptr<const Analysis> analysis) {
  PartialCholesky factor(std::move(analysis));
  Numbers numbers(factor, matrix);
  if (!numbers.eliminate())
    return Failure{FailureReason::not_positive_definite,
                   "the stiffness of a sector is not positive definite"};
  numbers.finish_schur();
  for (double x : factor.schur_.entries())
    if (!std::isfinite(x)) return Failure{FailureReason::not_finite, "the condensed stiffness is not finite"};
  return factor;
}

double PartialCholesky::Supernode::flops() const {
  const double n = n_columns, m = n_below;
  return n * n * n / 3 + m * n * n + m * m * n;
}

double PartialCholesky::factor_flops() const {
  double flops = 0;
  for (const Supernode& node : supernodes()) flops += node.flops();
  return flops;
}

double PartialCholesky::longest_chain_flops() const {
  const size_t n = supernodes().size();
  std::vector<double> work(n), flops(n), chain(n);  // of subtrees; of the chains below their roots
  double total_work = 0, longest = 0;
  for (size_t s = 0; s < n; ++s) {
    const Supernode& node = supernodes()[s];
    work[s] += node.work();
    flops[s] += node.flops();
    if (node.parent >= 0) {
      work[node.parent] += work[s];
      flops[node.parent] += flops[s];
    } else {
      total_work += work[s];
    }
  }
  for (size_t s = 0; s < n; ++s) {
    const Supernode& node = supernodes()[s];
    chain[s] = work[s] < worth_sharing * total_work
                   ? flops[s]
                   : chain[s] + (is_shared(node.n_below, node.flops())
                                     ? longest_chain_of_shared(node.n_columns, node.n_below)
                                     : node.flops());
    double& above = node.parent >= 0 ? chain[node.parent] : longest;
    above = std::max(above, chain[s]);
  }
  return longest;
}

PartialCholesky::Sweep PartialCholesky::sweep_through(const std::vector<char>& marked) const {
  std::vector<char> needed(supernodes().size(), 0);
  for (int i = 0; i < n_interior(); ++i)
    if (marked[i]) needed[analysis_->supernode_of_[i]] = 1;
  Sweep sweep{{}, std::vector<char>(size(), 0)};
  std::fill(sweep.visited.begin() + n_interior(), sweep.visited.end(), 1);
  for (size_t s = 0; s < supernodes().size(); ++s) {
    if (!needed[s]) continue;
    const Supernode& node = supernodes()[s];
    sweep.supernodes.push_back(static_cast<int>(s));
    std::fill_n(sweep.visited.begin() + node.first, node.n_columns, 1);
    if (node.parent >= 0) needed[node.parent] = 1;
  }
  return sweep;
}

PartialCholesky::Sweep PartialCholesky::full_sweep() const {
  return sweep_through(std::vector<char>(size(), 1));
}

double PartialCholesky::sweep_entries(const Sweep& sweep) const {
  double entries = 0;
  for (const int s : sweep.supernodes)
    entries +=
        double(supernodes()[s].n_columns) * (supernodes()[s].n_below + 0.5 * supernodes()[s].n_columns);
  return entries;
}

void PartialCholesky::eliminate(const Sweep& sweep, Matrix& loads) const {
  const int leading = loads.rows();
  for_blocks(leading, [&](int first, int n) {
    std::vector<double> passed_on;
    for (const int s : sweep.supernodes) {
      const Supernode& node = supernodes()[s];
      const int stride = node.stride(), *below = rows_below(node);
      const double* l = columns(node);
      double* own = loads.column(node.first) + first;
      solve_rows(CblasTrans, n, node.n_columns, l, stride, own, leading);
      if (node.n_below == 0) continue;
      passed_on.resize(size_t(n) * node.n_below);
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n, node.n_below, node.n_columns, 1, own, leading,
                  l + node.n_columns, stride, 0, passed_on.data(), n);
      for (int k = 0; k < node.n_below; ++k) {
        double* to = loads.column(below[k]) + first;
        const double* from = &passed_on[size_t(k) * n];
        for (int i = 0; i < n; ++i) to[i] -= from[i];
      }
    }
  });
}

void PartialCholesky::substitute(const Sweep& sweep, Matrix& x) const {
  const int leading = x.rows();
  for_blocks(leading, [&](int first, int n) {
    std::vector<double> known;
    for (auto s = sweep.supernodes.rbegin(); s != sweep.supernodes.rend(); ++s) {
      const Supernode& node = supernodes()[*s];
      const int stride = node.stride(), *below = rows_below(node);
      const double* l = columns(node);
      double* own = x.column(node.first) + first;
      known.resize(size_t(n) * node.n_below);
      for (int k = 0; k < node.n_below; ++k)
        std::copy_n(x.column(below[k]) + first, n, &known[size_t(k) * n]);
      if (node.n_below > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, node.n_columns, node.n_below, -1,
                    known.data(), n, l + node.n_columns, stride, 1, own, leading);
      solve_rows(CblasNoTrans, n, node.n_columns, l, stride, own, leading);
    }
  });
}

}  // namespace wheelwright
