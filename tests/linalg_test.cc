#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "wheelwright/base/parallel.h"
#include "wheelwright/linalg/column_basis.h"
#include "wheelwright/linalg/cyclic_chain.h"
#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/linalg/partial_cholesky.h"
#include "wheelwright/linalg/sparse_two_block_cholesky.h"
#include "wheelwright/linalg/two_block_cholesky.h"

namespace wheelwright {
namespace {

Matrix random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Matrix a(rows, columns);
  for (double& x : a.entries()) x = uniform(random);
  return a;
}

template <class Scalar>
double largest_difference(const DenseMatrix<Scalar>& a, const DenseMatrix<Scalar>& b) {
  double largest = 0;
  for (size_t k = 0; k < a.entries().size(); ++k)
    largest = std::max(largest, std::abs(a.entries()[k] - b.entries()[k]));
  return largest;
}

/// The five-point Laplacian of an n x n square with zero values outside, as a dense and as a sparse matrix.
struct Laplacian {
  explicit Laplacian(int n) : dense(n * n, n * n) {
    const auto number = [n](int i, int j) { return i + n * j; };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        dense(number(i, j), number(i, j)) = 4;
        if (i + 1 < n) couple(number(i, j), number(i + 1, j));
        if (j + 1 < n) couple(number(i, j), number(i, j + 1));
      }
    sparse.size = n * n;
    sparse.column_start.push_back(0);
    for (int j = 0; j < n * n; ++j) {
      for (int i = j; i < n * n; ++i)
        if (dense(i, j) != 0) {
          sparse.rows.push_back(i);
          sparse.values.push_back(dense(i, j));
        }
      sparse.column_start.push_back(static_cast<int>(sparse.rows.size()));
    }
  }
  Matrix dense;
  SparseSymmetric sparse;

 private:
  void couple(int a, int b) { dense(a, b) = dense(b, a) = -1; }
};

/// The square in nested dissection by one line: left, right, the line, which with the last row is trailing.
class CondensedSquare : public ::testing::Test {
 protected:
  static constexpr int n = 9;
  CondensedSquare() {
    for (int half = 0; half < 2; ++half)
      for (int j = 0; j + 1 < n; ++j)
        for (int i = half == 0 ? 0 : 5; i < (half == 0 ? 4 : n); ++i) order_.push_back(i + n * j);
    for (int j = 0; j + 1 < n; ++j) order_.push_back(4 + n * j);
    for (int i = 0; i < n; ++i) order_.push_back(i + n * (n - 1));
  }
  Laplacian laplacian_{n};
  std::vector<int> order_;
};

TEST_F(CondensedSquare, SolvesAsADenseCholesky) {
  const auto factor = PartialCholesky::factor(laplacian_.sparse, 1, order_, n);
  ASSERT_TRUE(factor);
  const Matrix loads = random_matrix(3, n * n, 1);
  Matrix x(3, n * n);
  for (int k = 0; k < n * n; ++k)
    for (int i = 0; i < 3; ++i) x(i, k) = loads(i, order_[k]);
  factor->eliminate(factor->full_sweep(), x);
  Matrix schur = factor->schur(), trailing(n, 3);
  ASSERT_TRUE(cholesky(schur));
  for (int i = 0; i < 3; ++i)
    for (int t = 0; t < n; ++t) trailing(t, i) = x(i, factor->n_interior() + t);
  cholesky_solve(schur, trailing);
  for (int i = 0; i < 3; ++i)
    for (int t = 0; t < n; ++t) x(i, factor->n_interior() + t) = trailing(t, i);
  factor->substitute(factor->full_sweep(), x);

  Matrix dense = laplacian_.dense, expected(n * n, 3);
  ASSERT_TRUE(cholesky(dense));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < n * n; ++k) expected(k, i) = loads(i, k);
  cholesky_solve(dense, expected);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < n * n; ++k) EXPECT_NEAR(x(i, k), expected(order_[k], i), 1e-13);
}

TEST_F(CondensedSquare, SolvesByTwoBlocksAsADenseCholesky) {
  SparseSymmetric in_order{.size = n * n, .column_start = {0}, .rows = {}, .values = {}};
  for (int j = 0; j < n * n; ++j) {
    for (int i = j; i < n * n; ++i)
      if (const double value = laplacian_.dense(order_[i], order_[j]); value != 0) {
        in_order.rows.push_back(i);
        in_order.values.push_back(value);
      }
    in_order.column_start.push_back(static_cast<int>(in_order.rows.size()));
  }
  std::vector<int> identity(n * n);
  std::iota(identity.begin(), identity.end(), 0);
  const auto analysis = PartialCholesky::analyze(in_order, 1, identity, n);
  ASSERT_TRUE(analysis);
  const Matrix root = random_matrix(n, n, 2), on_last = product(root, Op::none, root, Op::transpose);
  PackedLower<double> packed(n * n, n * n - n);
  for (int j = 0; j < n * n; ++j)
    for (int i = j; i < n * n; ++i) {
      packed(i, j) = laplacian_.dense(order_[i], order_[j]);
      if (j >= n * n - n) packed(i, j) += on_last(i - (n * n - n), j - (n * n - n));
    }
  const auto sparse = SparseTwoBlockCholesky::factor(in_order, on_last, *analysis);
  const auto dense = TwoBlockCholesky<double>::factor(packed);
  ASSERT_TRUE(sparse && dense);
  ASSERT_EQ(sparse->n_first(), dense->n_first());
  const Matrix loads = random_matrix(n * n, 3, 3);
  const auto solve = [&](const auto& factor) {
    Matrix x = loads;
    factor.eliminate(x);
    Matrix last = block(x, n * n - n, 0, n, 3);
    factor.solve_last(last);
    for (int j = 0; j < 3; ++j) std::copy_n(last.column(j), n, x.column(j) + n * n - n);
    factor.substitute(x);
    return x;
  };
  const Matrix x = solve(*sparse), expected = solve(*dense);
  for (size_t k = 0; k < x.entries().size(); ++k) EXPECT_NEAR(x.entries()[k], expected.entries()[k], 1e-13);
  const Matrix inverse = sparse->last_inverse(), inverse_expected = dense->last_inverse();
  for (size_t k = 0; k < inverse.entries().size(); ++k)
    EXPECT_NEAR(inverse.entries()[k], inverse_expected.entries()[k], 1e-13);
  Matrix indefinite = on_last;
  indefinite(0, 0) -= 1e3;
  EXPECT_FALSE(SparseTwoBlockCholesky::factor(in_order, indefinite, *analysis));
}

/// The longest chain of a matrix of diagonal 3 with `couplings`, as a share of its flops.
double longest_chain(int n, const std::vector<std::pair<int, int>>& couplings, int n_trailing) {
  SparseSymmetric matrix{.size = n, .column_start = {0}, .rows = {}, .values = {}};
  for (int j = 0; j < n; ++j) {
    matrix.rows.push_back(j);
    matrix.values.push_back(3);
    for (const auto& [column, row] : couplings)
      if (column == j) {
        matrix.rows.push_back(row);
        matrix.values.push_back(-1);
      }
    matrix.column_start.push_back(static_cast<int>(matrix.rows.size()));
  }
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto factor = PartialCholesky::factor(matrix, 1, order, n_trailing);
  if (!factor) throw std::runtime_error("not positive definite");
  return factor->longest_chain_flops() / factor->factor_flops();
}

// One path is all of a tridiagonal matrix, and a third of three that meet in a trailing unknown. Where two
// paths meet in a third, and so do two others, a chain is two of six paths.
// One front of 300 columns and 1300 rows below, whose blocks the threads share: its condensed matrix is B -
// A^T K^-1 A, with the same bytes on one thread and on four.
TEST(PartialCholeskyTest, LargeFrontsAreCondensedOnAnyNumberOfThreads) {
  constexpr int n = 300, n_trailing = 1300, size = n + n_trailing;
  std::mt19937 random(3);
  Matrix dense(size, size);
  SparseSymmetric matrix;
  matrix.size = size;
  matrix.column_start = {0};
  for (int j = 0; j < size; ++j) {
    for (int i = j; i < size; ++i) {
      const double value = i == j ? size : static_cast<double>(random() % 1000) / 1000;
      dense(i, j) = dense(j, i) = value;
      matrix.rows.push_back(i);
      matrix.values.push_back(value);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.rows.size()));
  }
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  const auto condensed_on = [&](int n_threads) {
    const ThreadLimit limit(n_threads);
    auto factor = PartialCholesky::factor(matrix, 1, order, n_trailing);
    EXPECT_LT(factor->longest_chain_flops(), 0.5 * factor->factor_flops());
    return factor->release_schur();
  };
  const Matrix one = condensed_on(1);
  EXPECT_EQ(one.entries(), condensed_on(4).entries());
  Matrix interior = block(dense, 0, 0, n, n), solved = block(dense, 0, n, n, n_trailing),
         expected = block(dense, n, n, n_trailing, n_trailing);
  ASSERT_TRUE(cholesky(interior));
  cholesky_solve(interior, solved);
  multiply(-1, block(dense, n, 0, n_trailing, n), Op::none, solved, Op::none, 1, expected);
  double error = 0;
  for (size_t k = 0; k < one.entries().size(); ++k)
    error = std::max(error, std::abs(one.entries()[k] - expected.entries()[k]));
  EXPECT_LT(error, 1e-14 * size);
}

TEST(PartialCholeskyTest, TheLongestChainIsThatOfTheTree) {
  constexpr int n = 60;
  std::vector<std::pair<int, int>> chain, three, tree;
  for (int k = 0; k < n; ++k) chain.emplace_back(k, k + 1);
  for (int k = 0; k < 3 * n; ++k) three.emplace_back(k, k % n == n - 1 ? 3 * n : k + 1);
  for (int k = 0; k < 6 * n; ++k) {
    const int path = k / n, end = path < 2 ? 4 * n : path < 4 ? 5 * n : 6 * n;
    tree.emplace_back(k, k % n == n - 1 ? end : k + 1);
  }
  EXPECT_NEAR(longest_chain(n + 1, chain, 1), 1, 1e-12);
  constexpr double of_supernodes = 0.02;  // which are not divided in quite the same way
  EXPECT_NEAR(longest_chain(3 * n + 1, three, 1), 1.0 / 3, of_supernodes);
  EXPECT_NEAR(longest_chain(6 * n + 1, tree, 1), 1.0 / 3, of_supernodes);
}

TEST_F(CondensedSquare, PartialSweepAgreesWithTheFullOne) {
  const auto factor = PartialCholesky::factor(laplacian_.sparse, 1, order_, n);
  ASSERT_TRUE(factor);
  std::vector<char> marked(n * n, 0);
  marked[0] = 1;  // in the left half
  const auto part = factor->sweep_through(marked), full = factor->full_sweep();
  ASSERT_LT(part.supernodes.size(), full.supernodes.size());

  Matrix loads(2, n * n);
  loads(0, 0) = 1;
  loads(1, n * n - 1) = 1;
  Matrix by_part = loads, by_full = loads;
  factor->eliminate(part, by_part);
  factor->eliminate(full, by_full);
  EXPECT_EQ(largest_difference(by_part, by_full), 0);
  factor->substitute(part, by_part);
  factor->substitute(full, by_full);
  int n_visited = 0;
  for (int k = 0; k < n * n; ++k) {
    if (!part.visited[k]) continue;
    ++n_visited;
    for (int i = 0; i < 2; ++i) EXPECT_EQ(by_part(i, k), by_full(i, k));
  }
  EXPECT_TRUE(part.visited[0]);
  EXPECT_LT(n_visited, n * n);
}

ComplexMatrix random_complex(int rows, int columns, unsigned seed) {
  const Matrix real = random_matrix(rows, columns, seed), imaginary = random_matrix(rows, columns, seed + 1);
  ComplexMatrix a(rows, columns);
  for (size_t k = 0; k < a.entries().size(); ++k)
    a.entries()[k] = {real.entries()[k], imaginary.entries()[k]};
  return a;
}

Matrix random(double, int rows, int columns, unsigned seed) { return random_matrix(rows, columns, seed); }
ComplexMatrix random(std::complex<double>, int rows, int columns, unsigned seed) {
  return random_complex(rows, columns, seed);
}

template <class Scalar>
PackedLower<Scalar> packed(const DenseMatrix<Scalar>& a, int n_first) {
  PackedLower<Scalar> result(a.rows(), n_first);
  for (int j = 0; j < a.columns(); ++j)
    for (int i = j; i < a.rows(); ++i) result(i, j) = a(i, j);
  return result;
}

template <class Scalar>
DenseMatrix<Scalar> product_of(const DenseMatrix<Scalar>& a, Op op_a, const DenseMatrix<Scalar>& b) {
  DenseMatrix<Scalar> c(op_a == Op::none ? a.rows() : a.columns(), b.columns());
  multiply(1, a, op_a, b, Op::none, 0, c);
  return c;
}

/// Solves equations whose matrix has `n` unknowns, block by block.
template <class Scalar>
void expect_to_solve_block_by_block(int n, const std::vector<int>& first_blocks) {
  const auto root = random(Scalar(), n, n, 5), x = random(Scalar(), n, 4, 7);
  DenseMatrix<Scalar> a = product_of(root, Op::adjoint, root);
  for (int i = 0; i < n; ++i) a(i, i) += n;
  const auto loads = product_of(a, Op::none, x);
  for (const int n_first : first_blocks) {
    SCOPED_TRACE(n_first);
    const auto factor = TwoBlockCholesky<Scalar>::factor(packed(a, n_first));
    ASSERT_TRUE(factor);
    auto solved = loads;
    factor->eliminate(solved);
    auto last = block(solved, n_first, 0, n - n_first, 4);
    factor->solve_last(last);
    EXPECT_LT(largest_difference(last, block(x, n_first, 0, n - n_first, 4)), 1e-12);
    for (int j = 0; j < 4; ++j) std::copy_n(last.column(j), n - n_first, solved.column(j) + n_first);
    factor->substitute(solved);
    EXPECT_LT(largest_difference(solved, x), 1e-12);
  }
}

// A few panels of columns, and parts of one.
TEST(TwoBlockCholesky, SolvesBlockByBlock) {
  constexpr int width = PackedLower<double>::panel_width;
  for (const int n : {23, 2 * width + 30}) {
    const std::vector<int> first_blocks =
        n < width ? std::vector<int>{0, 1, 9, n - 1, n} : std::vector<int>{0, 40, width, width + 7, n - 1, n};
    expect_to_solve_block_by_block<double>(n, first_blocks);
    expect_to_solve_block_by_block<std::complex<double>>(n, first_blocks);
  }
}

TEST(TwoBlockCholesky, IsNothingForAnIndefiniteMatrix) {
  PackedLower<std::complex<double>> a(2, 1);
  a(0, 0) = 1;
  a(1, 0) = {0, 2};
  a(1, 1) = 1;
  EXPECT_FALSE(TwoBlockCholesky<std::complex<double>>::factor(std::move(a)));
}

TEST(PackedLower, StoresLittleMoreThanHalfOfTheMatrix) {
  const int n = 8 * PackedLower<double>::panel_width;
  const PackedLower<double> a(n, n / 2);
  EXPECT_LT(a.n_entries(), 0.57 * n * n);
}

TEST(Dense, AProductOverNothingIsZero) {
  const Matrix c = product(Matrix(3, 0), Op::none, Matrix(0, 4), Op::none);
  EXPECT_EQ(c.columns(), 4);
  EXPECT_EQ(largest_entry(c), 0);
}

TEST(LuFactor, SolvesAndRefusesASingularMatrix) {
  constexpr int n = 7;
  Matrix a(n, n), x(n, 2);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) a(i, j) = std::sin(3.0 + i + 2 * j * j) + (i + j == n - 1 ? 2 : 0);
    for (int k = 0; k < 2; ++k) x(j, k) = std::cos(j + 5 * k);
  }
  const auto factor = LuFactor::factor(a);
  ASSERT_TRUE(factor);
  const Matrix solved = factor->solve(product(a, Op::none, x, Op::none));
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < n; ++i) EXPECT_NEAR(solved(i, k), x(i, k), 1e-12);
  for (int i = 0; i < n; ++i) a(i, 3) = 0;
  EXPECT_FALSE(LuFactor::factor(a));
}

TEST(Dense, NonzeroColumnsSeeTheSmallestNumbersAndNoSignOfZero) {
  Matrix a(3, 5);
  a(0, 0) = -0.0;
  a(2, 1) = std::numeric_limits<double>::denorm_min();
  a(1, 3) = NAN;
  a(0, 4) = -1;
  EXPECT_EQ(nonzero_columns(a), (std::vector<int>{1, 3, 4}));
  EXPECT_TRUE(std::isnan(largest_entry(a)));
}

TEST(ColumnBasis, FindsTheRankAndKeepsTheMatrix) {
  const int rank = 21;
  const Matrix a = product(random_matrix(70, rank, 2), Op::none, random_matrix(rank, 90, 3), Op::none);
  const ColumnBasis found = column_basis(a, 1e-12);
  EXPECT_EQ(found.basis.columns(), rank);
  EXPECT_LT(largest_difference(product(found.basis, Op::none, found.coordinates, Op::none), a), 1e-12);
  Matrix identity(rank, rank);
  for (int i = 0; i < rank; ++i) identity(i, i) = 1;
  EXPECT_LT(largest_difference(product(found.basis, Op::transpose, found.basis, Op::none), identity), 1e-14);
}

/// Hilbert's matrix: singular values that fall by an order of magnitude each.
TEST(ColumnBasis, DropsAtMostTheTolerance) {
  const int n = 40;
  Matrix a(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) a(i, j) = 1.0 / (i + j + 1);
  double longest = 0;
  for (int i = 0; i < n; ++i) longest += 1.0 / ((i + 1) * (i + 1));
  longest = std::sqrt(longest);
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const ColumnBasis found = column_basis(a, tolerance);
    EXPECT_LT(found.basis.columns(), n);
    const Matrix kept = product(found.basis, Op::none, found.coordinates, Op::none);
    for (int j = 0; j < n; ++j) {
      double rest = 0;
      for (int i = 0; i < n; ++i) rest += std::pow(a(i, j) - kept(i, j), 2);
      EXPECT_LE(std::sqrt(rest), tolerance * longest * (1 + 1e-3));
    }
    Matrix gram = product(found.basis, Op::transpose, found.basis, Op::none);
    for (int i = 0; i < gram.rows(); ++i) gram(i, i) -= 1;
    EXPECT_LT(largest_difference(gram, Matrix(gram.rows(), gram.rows())), 1e-14);
  }
}

TEST(ColumnBasis, OfZero) {
  const ColumnBasis found = column_basis(Matrix(5, 7), 1e-12);
  EXPECT_EQ(found.basis.columns(), 0);
  EXPECT_EQ(found.coordinates.rows(), 0);
}

/// root root^T + shift.
Matrix definite_matrix(int n, double shift, unsigned seed) {
  const Matrix root = random_matrix(n, n, seed);
  Matrix a = product(root, Op::none, root, Op::transpose);
  for (int i = 0; i < n; ++i) a(i, i) += shift;
  return a;
}

Matrix scaled(double factor, Matrix a) {
  for (double& x : a.entries()) x *= factor;
  return a;
}

/// A chain of links, as one dense matrix too.
struct Chain {
  Chain(int n_links_, double coupling)
      : Chain(n_links_, definite_matrix(3, 2, 4), scaled(coupling, random_matrix(3, 3, 5))) {}
  Chain(int n_links_, Matrix diagonal_, Matrix next_)
      : n(next_.rows()), n_links(n_links_), diagonal(std::move(diagonal_)), next(std::move(next_)) {
    dense = Matrix(n * n_links, n * n_links);
    for (int c = 0; c < n_links; ++c)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const int after = (c + 1) % n_links;
          dense(n * c + i, n * c + j) += diagonal(i, j);
          dense(n * c + i, n * after + j) += next(i, j);
          dense(n * after + j, n * c + i) += next(i, j);
        }
  }
  int n, n_links;
  Matrix diagonal, next, dense;
};

TEST(CyclicChain, SolvesAsADenseCholesky) {
  for (const double coupling : {0.1, 0.8})
    for (const int n_links : {2, 3, 7, 40}) {
      const Chain chain(n_links, coupling);
      const auto factor = CyclicChain::factor(chain.diagonal, chain.next, n_links);
      ASSERT_TRUE(factor);
      const Matrix loads = random_matrix(chain.n, 2 * n_links, 6);
      const Matrix x = factor->solve(loads);
      Matrix dense = chain.dense, expected(chain.n * n_links, 2);
      std::copy_n(loads.data(), loads.entries().size(), expected.data());
      ASSERT_TRUE(cholesky(dense));
      cholesky_solve(dense, expected);
      for (size_t k = 0; k < x.entries().size(); ++k)
        EXPECT_NEAR(x.entries()[k], expected.entries()[k], 1e-12);
    }
}

// What is left of the pivots' changes in the end is rounding, whose size depends on the chain and on the
// BLAS.
TEST(CyclicChain, FactorsEveryDefiniteChain) {
  for (const int n : {1, 2, 5, 12, 30, 60})
    for (const double strength : {0.5, 0.95, 0.999})
      for (unsigned seed = 0; seed < 10; ++seed) {
        const Matrix diagonal = definite_matrix(n, 1e-2, seed);
        const Chain chain(8, diagonal, scaled(-0.5 * strength, diagonal));
        const auto factor = CyclicChain::factor(chain.diagonal, chain.next, chain.n_links);
        ASSERT_TRUE(factor) << n << ' ' << strength << ' ' << seed;
        const Matrix loads = random_matrix(n, chain.n_links, 6);
        const Matrix x = factor->solve(loads);
        Matrix residual(n * chain.n_links, 1), all = residual;
        std::copy_n(loads.data(), loads.entries().size(), residual.data());
        std::copy_n(x.data(), x.entries().size(), all.data());
        multiply(-1, chain.dense, Op::none, all, Op::none, 1, residual);
        EXPECT_LT(largest_entry(residual), 1e-12 * largest_entry(chain.dense) * largest_entry(x));
      }
}

TEST(CyclicChain, RefusesAnIndefiniteChain) {
  const Chain chain(8, 5.0);
  Matrix dense = chain.dense;
  ASSERT_FALSE(cholesky(dense));
  const auto factor = CyclicChain::factor(chain.diagonal, chain.next, chain.n_links);
  ASSERT_FALSE(factor);
  EXPECT_EQ(factor.failure().reason, FailureReason::not_positive_definite);
}

}  // namespace
}  // namespace wheelwright
