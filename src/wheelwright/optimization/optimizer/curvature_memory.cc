#include "wheelwright/optimization/optimizer/curvature_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheelwright {
namespace {

constexpr double min_curvature = 1e-3;  // cosine between move and change

}  // namespace

void remember(CurvaturePair pair, double move_square, double move_change, double change_square,
              CurvatureMemory& memory) {
  if (!(move_change > min_curvature * std::sqrt(move_square * change_square))) return;
  if (memory.size() == max_curvature_pairs) memory.erase(memory.begin());
  memory.push_back(std::move(pair));
}

double ShiftedHessian::scale(const Matrix& products, int first_move, int n_pairs) {
  double minimum = std::numeric_limits<double>::infinity();
  for (int move = first_move; move < first_move + n_pairs; ++move) {
    const int change = move + n_pairs;
    minimum = std::min(minimum, products(change, change) / products(move, change));
  }
  return n_pairs == 0 ? 0 : minimum;
}

// B = scale - W M^-1 W^T with W = (scale S, Y) and M = ((scale S.S, L), (L^T, -D)), where L is the strict
// lower triangle of S.Y and D its diagonal. By Woodbury, with c = scale + shift, (B + shift)^-1 = (1 + W (c M
// - W.W)^-1 W^T) / c.
ShiftedHessian::ShiftedHessian(const Matrix& products, int first_move, int n_pairs, double shift)
    : products_(products),
      first_move_(first_move),
      n_pairs_(n_pairs),
      scale_(scale(products, first_move, n_pairs)),
      diagonal_(scale_ + shift),
      inverse_(2 * n_pairs, 2 * n_pairs) {
  const auto product = [&](int a, int b) { return products_(first_move_ + a, first_move_ + b); };
  const int k = n_pairs;
  Matrix small(2 * k, 2 * k);
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) {
      const double moves = product(i, j), mixed = product(i, k + j), changes = product(k + i, k + j);
      const double lower = i > j ? mixed : 0, diagonal = i == j ? mixed : 0;
      small(i, j) = diagonal_ * scale_ * moves - scale_ * scale_ * moves;
      small(i, k + j) = diagonal_ * lower - scale_ * mixed;
      small(k + j, i) = small(i, k + j);
      small(k + i, k + j) = -diagonal_ * diagonal - changes;
    }
  for (int i = 0; i < 2 * k; ++i) inverse_(i, i) = 1;
  const bool is_regular = k == 0 || lu_solve(small, inverse_);
  if (!is_regular) n_pairs_ = 0;  // pairs that are linearly dependent up to rounding
}

std::vector<double> ShiftedHessian::solve(const std::vector<double>& coefficients) const {
  const int k = n_pairs_;
  std::vector<double> along(2 * k), weights(2 * k);
  const auto weight_of = [&](int i) { return i < k ? scale_ : 1.0; };
  for (int i = 0; i < 2 * k; ++i)
    for (size_t j = 0; j < coefficients.size(); ++j)
      along[i] += weight_of(i) * products_(first_move_ + i, static_cast<int>(j)) * coefficients[j];
  std::vector<double> result = coefficients;
  for (int i = 0; i < 2 * k; ++i) {
    for (int j = 0; j < 2 * k; ++j) weights[i] += inverse_(i, j) * along[j];
    result[first_move_ + i] += weight_of(i) * weights[i];
  }
  for (double& value : result) value /= diagonal_;
  return result;
}

}  // namespace wheelwright
