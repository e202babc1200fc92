#include "wheelwright/mechanics/state/turn_harmonics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "wheelwright/base/periodic.h"

namespace wheelwright {

TurnHarmonics::TurnHarmonics(int n_positions, int n_sectors) {
  const int n = n_positions * n_sectors;
  for (int i = 0; i < n_positions; ++i)
    for (int s = 0; s < n_sectors; ++s) samples_.push_back(wrap(i - s * n_positions, n));
  for (int step = 0; step < n; ++step) {
    cosines_.push_back(std::cos(2 * std::numbers::pi * step / n));
    sines_.push_back(std::sin(2 * std::numbers::pi * step / n));
  }
}

Matrix TurnHarmonics::waves() const {
  const int n = n_cases();
  Matrix waves(n, n);
  for (int wave = 0; wave < n; ++wave) {
    const int k = harmonic(wave);
    const double scale = std::sqrt((is_one_wave(k) ? 1.0 : 2.0) / n);
    const std::vector<double>& values = wave % 2 == 1 || is_one_wave(k) ? cosines_ : sines_;
    for (int j = 0; j < n; ++j)
      waves(j, wave) = scale * values[static_cast<std::size_t>(static_cast<long long>(k) * samples_[j] % n)];
  }
  return waves;
}

Matrix TurnHarmonics::filter(std::span<const double> factors) const {
  const int n = n_cases();
  std::vector<double> of_distance(n, 0.0);
  for (int distance = 0; distance < n; ++distance)
    for (int k = 0; k < n_harmonics(); ++k)
      of_distance[distance] +=
          (is_one_wave(k) ? 1.0 : 2.0) / n * factors[k] * cosine(static_cast<long long>(k) * distance);
  Matrix filter(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) filter(i, j) = of_distance[std::abs(samples_[i] - samples_[j])];
  return filter;
}

Matrix combined_blocks(const Matrix& x, const Matrix& map) {
  const int per_block = x.columns() / map.rows();
  // Columns follow each other in memory, so that a block is one column of a matrix of other dimensions.
  auto blocks = Matrix::unfilled(x.rows() * per_block, map.rows());
  std::ranges::copy(x.entries(), blocks.data());
  const Matrix combined = product(blocks, Op::none, map, Op::none);
  auto result = Matrix::unfilled(x.rows(), per_block * map.columns());
  std::ranges::copy(combined.entries(), result.data());
  return result;
}

}  // namespace wheelwright
