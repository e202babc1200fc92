#include "wheelwright/mechanics/elasticity/smooth_ball.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/base/integer_power.h"

namespace wheelwright {
namespace {

constexpr int n_coordinates = 5;
constexpr int half_exponent = SmoothBall::exponent / 2;

using SmallMatrix = std::array<Vec<5>, 5>;  ///< of which the lower triangle counts

/// sum_j |d_j|^64 of the points d_j = x_j - c, with its derivatives with respect to c.
struct SumOfPowers {
  double value = 0;
  Vec<5> slope{};
  SmallMatrix second{};
};

/// The second derivative of |d|^64 times a vector.
Vec<5> second_times(const Vec<5>& d, const Vec<5>& a) {
  const double square = dot<5>(d, d), power = integer_power(square, half_exponent - 2), along = dot<5>(d, a);
  Vec<5> result;
  for (int i = 0; i < n_coordinates; ++i)
    result[i] = 2 * half_exponent * power * (square * a[i] + 2 * (half_exponent - 1) * along * d[i]);
  return result;
}

/// Points in blocks, coordinate by coordinate, so that a block is computed at once.
constexpr int block_size = 8;
using Block = std::array<std::array<double, block_size>, n_coordinates>;

std::vector<Block> blocks_of(std::span<const Vec<5>> points) {
  std::vector<Block> blocks((points.size() + block_size - 1) / block_size);
  for (std::size_t j = 0; j < blocks.size() * block_size; ++j)
    for (int i = 0; i < n_coordinates; ++i)
      blocks[j / block_size][i][j % block_size] = j < points.size() ? points[j][i] : 0;
  return blocks;
}

double total(const std::array<double, block_size>& lanes) {
  double sum = 0;
  for (const double x : lanes) sum += x;
  return sum;
}

/// Sums over points in blocks, seen from a center. They differ from it in the first n coordinates only.
template <int n>
SumOfPowers sum_of_powers(std::span<const Block> blocks, const Vec<5>& center, int n_points) {
  using Lanes = std::array<double, block_size>;
  Lanes value{};
  std::array<Lanes, n> slope{};
  std::array<std::array<Lanes, n>, n> second{};
  Lanes diagonal{};
  for (const Block& block : blocks) {
    std::array<Lanes, n> d;
    Lanes square{};
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < block_size; ++l) {
        d[i][l] = block[i][l] - center[i];
        square[l] += d[i][l] * d[i][l];
      }
    const auto left = n_points - block_size * (&block - blocks.data());
    Lanes first, outer;
    for (int l = 0; l < block_size; ++l) {
      const double power = l < left ? integer_power(square[l], half_exponent - 2) : 0;
      value[l] += power * square[l] * square[l];
      first[l] = 2 * half_exponent * power * square[l];
      outer[l] = 4 * half_exponent * (half_exponent - 1) * power;
      diagonal[l] += first[l];
    }
    for (int j = 0; j < n; ++j) {
      for (int l = 0; l < block_size; ++l) slope[j][l] -= first[l] * d[j][l];
      for (int i = j; i < n; ++i)
        for (int l = 0; l < block_size; ++l) second[i][j][l] += outer[l] * d[i][l] * d[j][l];
    }
  }
  SumOfPowers sum{.value = total(value)};
  for (int j = 0; j < n; ++j) {
    sum.slope[j] = total(slope[j]);
    for (int i = j; i < n; ++i) sum.second[i][j] = total(second[i][j]);
  }
  for (int j = 0; j < n_coordinates; ++j) sum.second[j][j] += total(diagonal);
  return sum;
}

/// x with a x = b for a positive definite matrix, by Cholesky's factor; nothing if it is not.
std::optional<Vec<5>> solved(SmallMatrix a, Vec<5> b) {
  for (int j = 0; j < n_coordinates; ++j) {
    for (int k = 0; k < j; ++k)
      for (int i = j; i < n_coordinates; ++i) a[i][j] -= a[i][k] * a[j][k];
    if (!(a[j][j] > 0)) return {};
    const double root = std::sqrt(a[j][j]);
    for (int i = j; i < n_coordinates; ++i) a[i][j] /= root;
  }
  for (int j = 0; j < n_coordinates; ++j) {
    for (int k = 0; k < j; ++k) b[j] -= a[j][k] * b[k];
    b[j] /= a[j][j];
  }
  for (int j = n_coordinates - 1; j >= 0; --j) {
    for (int i = j + 1; i < n_coordinates; ++i) b[j] -= a[i][j] * b[i];
    b[j] /= a[j][j];
  }
  return b;
}

/// Newton's step of the 64th root of the sum, which is convex.
std::optional<Vec<5>> newton_step(const SumOfPowers& sum) {
  constexpr double share = 1 - 0.5 / half_exponent;
  SmallMatrix second = sum.second;
  Vec<5> slope;
  for (int j = 0; j < n_coordinates; ++j) {
    slope[j] = -sum.slope[j] / sum.value;
    for (int i = j; i < n_coordinates; ++i)
      second[i][j] = second[i][j] / sum.value - share * sum.slope[i] * sum.slope[j] / (sum.value * sum.value);
  }
  return solved(second, slope);
}

bool is_in_first_three(std::span<const Vec<5>> points) {
  return std::ranges::all_of(points, [](const Vec<5>& x) { return x[3] == 0 && x[4] == 0; });
}

}  // namespace

SmoothBall::SmoothBall(std::span<const Vec<5>> points, const SmallestBall& smallest)
    : from_center_(points.begin(), points.end()),
      center_(smallest.center()),
      radius_(0),
      smallest_radius_(smallest.radius()) {
  if (smallest_radius_ == 0) return;
  for (Vec<5>& d : from_center_)
    for (int i = 0; i < n_coordinates; ++i) d[i] = (d[i] - center_[i]) / smallest_radius_;
  const std::vector<Block> blocks = blocks_of(from_center_);
  const auto sum_about = is_in_first_three(from_center_) ? sum_of_powers<3> : sum_of_powers<n_coordinates>;
  const auto n_points = static_cast<int>(points.size());
  constexpr int most_steps = 40;
  constexpr double tolerance = 1e-13, shortest = 1e-6, rounding = 1e-12;
  Vec<5> center{};
  SumOfPowers sum = sum_about(blocks, center, n_points);
  for (int k = 0; k < most_steps; ++k) {
    const auto step = newton_step(sum);
    if (!step) break;
    for (double factor = 1; factor > shortest; factor /= 2) {
      Vec<5> next = center;
      for (int i = 0; i < n_coordinates; ++i) next[i] += factor * (*step)[i];
      const SumOfPowers there = sum_about(blocks, next, n_points);
      if (!(there.value <= (1 + rounding) * sum.value)) continue;
      center = next;
      sum = there;
      break;
    }
    if (norm<5>(*step) < tolerance) break;
  }
  second_ = sum.second;
  radius_ = smallest_radius_ * std::pow(sum.value, 0.5 / half_exponent);
  for (int i = 0; i < n_coordinates; ++i) center_[i] += smallest_radius_ * center[i];
  for (Vec<5>& d : from_center_)
    for (int i = 0; i < n_coordinates; ++i) d[i] -= center[i];
}

std::vector<Vec<5>> SmoothBall::slopes_of_radius() const {
  std::vector<Vec<5>> slopes(from_center_.size(), Vec<5>{});
  if (radius_ == 0) return slopes;
  const double relative = radius_ / smallest_radius_, sum = integer_power(relative, 2 * half_exponent);
  for (std::size_t j = 0; j < slopes.size(); ++j) {
    const Vec<5>& d = from_center_[j];
    const double factor = relative * integer_power(dot<5>(d, d), half_exponent - 1) / sum;
    for (int i = 0; i < n_coordinates; ++i) slopes[j][i] = factor * d[i];
  }
  return slopes;
}

std::vector<Vec<5>> SmoothBall::slopes_of_center(const Vec<5>& a) const {
  std::vector<Vec<5>> slopes(from_center_.size(), Vec<5>{});
  if (radius_ == 0) {  // all points are one: the center moves with their mean
    for (Vec<5>& slope : slopes)
      for (int i = 0; i < n_coordinates; ++i) slope[i] = a[i] / static_cast<double>(slopes.size());
    return slopes;
  }
  const auto weights = solved(second_, a);
  if (!weights) return slopes;
  for (std::size_t j = 0; j < slopes.size(); ++j) slopes[j] = second_times(from_center_[j], *weights);
  return slopes;
}

}  // namespace wheelwright
