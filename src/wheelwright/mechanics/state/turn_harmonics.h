#pragma once

#include <span>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// The harmonics of what a material point goes through in a turn of the wheel. The load cases of a point of
/// one sector (StrainsAtPoint) are samples of the turn at equal steps: N = positions of a sector * sectors.
/// Load case i n_sectors + s is the sample i - s n_positions, up to whole turns. Harmonic n, 0 <= n <= N / 2,
/// repeats itself n times per turn.
class TurnHarmonics {
 public:
  TurnHarmonics(int n_positions, int n_sectors);

  int n_cases() const { return static_cast<int>(samples_.size()); }
  int n_harmonics() const { return n_cases() / 2 + 1; }

  /// Orthonormal columns that map amplitudes to values in the load cases, [load case, wave]: the mean, cosine
  /// and sine of every harmonic, and for even N the cosine of the last one. A sum of squares over the load
  /// cases is that over the amplitudes.
  Matrix waves() const;

  /// The harmonic of a wave.
  static int harmonic(int wave) { return (wave + 1) / 2; }

  /// The symmetric matrix over the load cases that multiplies each harmonic by its factor.
  Matrix filter(std::span<const double> factors) const;

 private:
  /// cos(2 pi n / N).
  double cosine(long long n) const { return cosines_[static_cast<std::size_t>(n % n_cases())]; }
  bool is_one_wave(int harmonic) const { return harmonic == 0 || 2 * harmonic == n_cases(); }

  std::vector<int> samples_;  ///< of the load cases
  std::vector<double> cosines_, sines_;
};

/// Columns in as many blocks as `map` has rows, equally many in each, combined block by block: block j of the
/// result is the sum over i of map(i, j) times block i of x.
Matrix combined_blocks(const Matrix& x, const Matrix& map);

}  // namespace wheelwright
