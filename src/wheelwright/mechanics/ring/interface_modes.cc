#include "wheelwright/mechanics/ring/interface_modes.h"

#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "wheelwright/base/parallel.h"
#include "wheelwright/linalg/column_basis.h"

namespace wheelwright {
namespace {

/// The norm of the remainder of a random combination of all columns beyond the strong modes, with respect to
/// their own stiffness. The coupling of a single weak mode is even smaller, and its third power is neglected.
constexpr double weakest = 1e-3;

/// Columns and rows of a product that one thread computes.
constexpr int columns_together = 192, tile_rows = 256;

/// The same of whole columns.
constexpr int whole_columns_together = 96;

void for_column_blocks(int columns, const std::function<void(int first, int n)>& f) {
  parallel_for((columns + whole_columns_together - 1) / whole_columns_together, [&](int k) {
    const int first = k * whole_columns_together;
    f(first, std::min(whole_columns_together, columns - first));
  });
}

/// c += alpha op(a) b, shared among the threads in tiles: of few columns, too.
void add_product(double alpha, const Matrix& a, Op op, const Matrix& b, Matrix& c) {
  const int n_rows = c.rows(), n_columns = c.columns(), down = (n_rows + tile_rows - 1) / tile_rows,
            across = (n_columns + columns_together - 1) / columns_together;
  parallel_for(down * across, [&](int tile) {
    const int row = tile % down * tile_rows, column = tile / down * columns_together;
    cblas_dgemm(CblasColMajor, op == Op::none ? CblasNoTrans : CblasTrans, CblasNoTrans,
                std::min(tile_rows, n_rows - row), std::min(columns_together, n_columns - column), b.rows(),
                alpha, op == Op::none ? a.data() + row : a.column(row), std::max(1, a.rows()),
                b.column(column), std::max(1, b.rows()), 1, c.column(column) + row, n_rows);
  });
}

Matrix shared_product(const Matrix& a, Op op, const Matrix& b) {
  Matrix c(op == Op::none ? a.rows() : a.columns(), b.columns());
  add_product(1, a, op, b, c);
  return c;
}

/// b = op(l)^-1 b.
void solve_triangle(const Matrix& l, Op op, Matrix& b) {
  for_column_blocks(b.columns(), [&](int first, int n) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, op == Op::none ? CblasNoTrans : CblasTrans,
                CblasNonUnit, l.rows(), n, 1, l.data(), l.rows(), b.column(first), b.rows());
  });
}

/// c -= a^T a, of which the columns up to the diagonal are computed and mirrored.
void subtract_gram(const Matrix& a, Matrix& c) {
  for_column_blocks(c.columns(), [&](int first, int n) {
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, c.rows() - first, n, a.rows(), -1, a.column(first),
                a.rows(), a.column(first), a.rows(), 1, c.column(first) + first, c.rows());
  });
}

void mirror_lower_triangle(Matrix& c) {
  for (int j = 0; j < c.columns(); ++j)
    for (int i = j + 1; i < c.rows(); ++i) c(j, i) = c(i, j);
}

/// Puts `part` into a larger matrix.
void put(const Matrix& part, int first_row, int first_column, Matrix& a) {
  for (int j = 0; j < part.columns(); ++j)
    std::copy_n(part.column(j), part.rows(), a.column(first_column + j) + first_row);
}

/// The values of the sectors that are `ahead` sectors ahead.
Matrix shifted(const Matrix& x, int ahead, int n_sectors) {
  auto result = Matrix::unfilled(x.rows(), x.columns());
  for (int c = 0; c < x.columns(); ++c) {
    const int sector = c % n_sectors, from = (sector + ahead + n_sectors) % n_sectors;
    std::copy_n(x.column(c - sector + from), x.rows(), result.column(c));
  }
  return result;
}

Matrix stacked(const Matrix& top, const Matrix& bottom) {
  auto result = Matrix::unfilled(top.rows() + bottom.rows(), top.columns());
  put(top, 0, 0, result);
  put(bottom, top.rows(), 0, result);
  return result;
}

double longest_column(const Matrix& a) {
  double longest = 0;
  for (int j = 0; j < a.columns(); ++j) longest = std::max(longest, cblas_dnrm2(a.rows(), a.column(j), 1));
  return longest;
}

}  // namespace

std::optional<InterfaceModes> InterfaceModes::find(const Matrix& link, const Matrix& next, int n_interface) {
  const int n = n_interface, n_outer = link.rows() - n;
  InterfaceModes modes;
  modes.factor_ = block(link, 0, 0, n, n);
  if (!cholesky(modes.factor_)) return std::nullopt;
  const Matrix& l = modes.factor_;
  modes.extension_ = block(link, 0, n, n, n_outer);
  solve_triangle(l, Op::none, modes.extension_);
  Matrix link_outer = block(link, n, n, n_outer, n_outer);
  subtract_gram(modes.extension_, link_outer);
  mirror_lower_triangle(link_outer);
  solve_triangle(l, Op::transpose, modes.extension_);
  for (double& x : modes.extension_.entries()) x = -x;

  const Matrix& extension = modes.extension_;
  const Matrix next_ii = block(next, 0, 0, n, n), next_oi = block(next, n, 0, n_outer, n);
  Matrix next_outer = block(next, 0, n, n, n_outer);  // of the interface, for the outer line of the next one
  add_product(1, next_ii, Op::none, extension, next_outer);
  Matrix next_of_outer = block(next, n, n, n_outer, n_outer);
  add_product(1, next_oi, Op::none, extension, next_of_outer);
  add_product(1, extension, Op::transpose, next_outer, next_of_outer);
  Matrix previous_outer = transposed(next_oi);
  add_product(1, next_ii, Op::transpose, extension, previous_outer);
  solve_triangle(l, Op::none, next_outer);
  solve_triangle(l, Op::none, previous_outer);

  modes.next_ = next_ii;
  solve_triangle(l, Op::none, modes.next_);
  modes.next_ = transposed(modes.next_);
  solve_triangle(l, Op::none, modes.next_);
  modes.next_ = transposed(modes.next_);
  std::vector<double> scales;  // of outer displacements, so that the link is about the identity on them too
  for (int i = 0; i < n_outer; ++i) {
    if (!(link_outer(i, i) > 0)) return std::nullopt;
    scales.push_back(1 / std::sqrt(link_outer(i, i)));
  }
  if (!modes.choose_strong_modes(next_outer, previous_outer, scales)) return std::nullopt;
  modes.reduce(link_outer, next_outer, previous_outer, next_of_outer);
  return modes;
}

/// The range of random combinations of the columns that the modes are to span, until what is left of them is
/// small (Halko, Martinsson, Tropp 2011, algorithm 4.2).
bool InterfaceModes::choose_strong_modes(const Matrix& next_outer, const Matrix& previous_outer,
                                         std::span<const double> scales) {
  const int n = n_interface(), together = std::clamp(n / 16, 8, 192);
  std::mt19937 random(1);
  const auto combinations = [&](int rows) {
    auto result = Matrix::unfilled(rows, together);
    for (double& x : result.entries()) x = std::ldexp(static_cast<double>(random()), -31) - 1;
    return result;
  };
  std::vector<Matrix> found;
  const auto subtract_found = [&](Matrix& x) {
    for (const Matrix& modes : found)
      add_product(-1, modes, Op::none, shared_product(modes, Op::transpose, x), x);
  };
  for (int n_found = 0;; n_found += found.back().columns()) {
    if (2 * n_found > n) return false;
    Matrix left = shared_product(next_, Op::none, combinations(n));
    add_product(1, next_, Op::transpose, combinations(n), left);
    add_product(1, next_outer, Op::none, scaled_rows(scales, combinations(n_outer())), left);
    add_product(1, previous_outer, Op::none, scaled_rows(scales, combinations(n_outer())), left);
    subtract_found(left);
    subtract_found(left);
    if (longest_column(left) < weakest) break;
    Matrix basis = column_basis(left, 1e-8).basis;
    subtract_found(basis);
    found.push_back(column_basis(basis, 1e-8).basis);
  }
  int n_strong = 0;
  for (const Matrix& modes : found) n_strong += modes.columns();
  strong_ = Matrix::unfilled(n, n_strong);
  n_strong = 0;
  for (const Matrix& modes : found) {
    put(modes, 0, n_strong, strong_);
    n_strong += modes.columns();
  }
  return true;
}

void InterfaceModes::reduce(const Matrix& link_outer, const Matrix& next_outer, const Matrix& previous_outer,
                            const Matrix& next_of_outer) {
  const int n = n_interface(), n_kept = n_strong() + n_outer();
  const auto beside_outer = [&](const Matrix& of_strong, const Matrix& of_outer) {
    auto result = Matrix::unfilled(n, n_kept);
    put(of_strong, 0, 0, result);
    put(of_outer, 0, n_strong(), result);
    return result;
  };
  weak_next_ = beside_outer(shared_product(next_, Op::none, strong_), next_outer);
  weak_previous_ = beside_outer(shared_product(next_, Op::transpose, strong_), previous_outer);
  // The strong modes feel this of the next sector and of the one before.
  const Matrix from_next = shared_product(strong_, Op::transpose, weak_next_),
               from_previous = shared_product(strong_, Op::transpose, weak_previous_);
  add_product(-1, strong_, Op::none, from_next, weak_next_);
  add_product(-1, strong_, Op::none, from_previous, weak_previous_);

  Matrix own(n_kept, n_kept), next(n_kept, n_kept), second_next(n_kept, n_kept);
  for (int i = 0; i < n_strong(); ++i) own(i, i) = 1;
  put(link_outer, n_strong(), n_strong(), own);
  subtract_gram(weak_next_, own);
  subtract_gram(weak_previous_, own);
  mirror_lower_triangle(own);
  put(from_next, 0, 0, next);
  put(transposed(block(from_previous, 0, n_strong(), n_strong(), n_outer())), n_strong(), 0, next);
  put(next_of_outer, n_strong(), n_strong(), next);
  add_product(-1, weak_previous_, Op::transpose, weak_next_, second_next);
  stiffness_ = {transposed(second_next), transposed(next), std::move(own), std::move(next),
                std::move(second_next)};
}

void InterfaceModes::subtract_strong(Matrix& x) const {
  add_product(-1, strong_, Op::none, shared_product(strong_, Op::transpose, x), x);
}

void InterfaceModes::solve_weak(Matrix& loads, int n_sectors) const {
  constexpr int most_terms = 50;
  constexpr double rounding = 1e-15;
  const double largest = largest_entry(loads);
  Matrix term = loads;
  double size = largest, ratio = 1;
  for (int k = 0; k < most_terms && size * ratio > rounding * largest; ++k) {
    Matrix next(term.rows(), term.columns());
    add_product(-1, next_, Op::none, shifted(term, 1, n_sectors), next);
    add_product(-1, next_, Op::transpose, shifted(term, -1, n_sectors), next);
    subtract_strong(next);
    loads = sum(std::move(loads), next);
    const double next_size = largest_entry(next);
    ratio = next_size / size;
    size = next_size;
    term = std::move(next);
  }
}

Matrix InterfaceModes::eliminate(Matrix& loads, int n_sectors) const {
  const int n = n_interface();
  Matrix z = block(loads, 0, 0, n, loads.columns()), outer = block(loads, n, 0, n_outer(), loads.columns());
  add_product(1, extension_, Op::transpose, z, outer);
  solve_triangle(factor_, Op::none, z);
  loads = stacked(shared_product(strong_, Op::transpose, z), outer);
  subtract_strong(z);
  solve_weak(z, n_sectors);
  add_product(-1, weak_next_, Op::transpose, shifted(z, -1, n_sectors), loads);
  add_product(-1, weak_previous_, Op::transpose, shifted(z, 1, n_sectors), loads);
  return z;
}

Matrix InterfaceModes::displacements(const Matrix& strong, const Matrix& outer, const Matrix& weak,
                                     int n_sectors) const {
  const Matrix kept = stacked(strong, outer);
  Matrix z(n_interface(), kept.columns());
  add_product(-1, weak_next_, Op::none, shifted(kept, 1, n_sectors), z);
  add_product(-1, weak_previous_, Op::none, shifted(kept, -1, n_sectors), z);
  solve_weak(z, n_sectors);
  if (weak.columns() > 0) z = sum(std::move(z), weak);
  add_product(1, strong_, Op::none, strong, z);
  solve_triangle(factor_, Op::transpose, z);
  add_product(1, extension_, Op::none, outer, z);
  return z;
}

}  // namespace wheelwright
