#pragma once

#include <functional>
#include <optional>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// The discrete Fourier transform over the sectors of a ring, of real data: x_s = sum_h X_h w^(h s) with
/// w = exp(2 pi i / n_sectors). Only the harmonics 0 <= h <= n_sectors / 2 are kept; the others are
/// conjugates.
class SectorHarmonics {
 public:
  explicit SectorHarmonics(int n_sectors);

  int n_sectors() const { return n_sectors_; }
  int n_harmonics() const { return n_sectors_ / 2 + 1; }

  /// w^(harmonic * shift).
  std::complex<double> phase(int harmonic, int shift) const;

  /// Maps rows x n_sectors (one column per sector) to rows x n_harmonics.
  ComplexMatrix forward(const Matrix& by_sector) const;

  /// rows x n_harmonics to rows x n_sectors.
  Matrix backward(const ComplexMatrix& by_harmonic) const;

  /// The transforms of several vectors. By sectors: column = vector * n_sectors + sector. By harmonics: one
  /// matrix per harmonic, with one column per vector.
  std::vector<ComplexMatrix> forward_each(const Matrix& by_sector) const;
  Matrix backward_each(const std::vector<ComplexMatrix>& by_harmonic) const;

  /// A linear map on the vectors of the ring that is the same for all sectors, from its blocks
  /// `of_harmonic(h)`, all of this size. Place `ahead` of the result maps the vector of a sector to that of
  /// the sector `ahead` sectors farther on, modulo n_sectors(); places that are farther away than `farthest`
  /// in both directions are empty. `together`: how many blocks exist at a time; by default at least four, and
  /// as many as take a quarter of a gigabyte.
  std::vector<Matrix> between_sectors(int rows, int columns, int farthest,
                                      const std::function<ComplexMatrix(int harmonic)>& of_harmonic,
                                      std::optional<int> together = {}) const;

 private:
  int n_sectors_;
  Matrix forward_real_, forward_imaginary_;    // n_sectors x n_harmonics
  Matrix backward_real_, backward_imaginary_;  // n_harmonics x n_sectors, with the conjugates' weight
};

}  // namespace wheelwright
