#pragma once

#include <span>
#include <vector>

namespace wheelwright {

/// A function of the values of one quantity at all load positions of a sector, and its derivative with
/// respect to each of them.
struct OfPositions {
  double value;
  std::vector<double> slopes;
};

// All functions here have the same value for the positions in reverse order.

OfPositions mean_of(std::span<const double> values);

/// (1/s) ln(mean exp(s (x_i - max))) + max: between the mean and the maximum, which it approaches as the
/// sharpness s grows [1/unit of x]. With s < 0 between the mean and the minimum.
OfPositions smooth_maximum(std::span<const double> values, double sharpness);

/// The maximum, with the slopes of a smooth maximum of sharpness 10 over the range of the values: the
/// difference between the two is treated as constant. If all values are equal, the slopes are those of the
/// mean.
OfPositions maximum_of(std::span<const double> values);

/// The same for the minimum.
OfPositions minimum_of(std::span<const double> values);

/// greatest_of() minus least_of(): the run-out when the values are travels.
OfPositions peak_to_peak_of(std::span<const double> values);

/// The amplitude of harmonic k >= 1 of the values, those of k N_s waves per revolution: 2/n |sum_j x_j exp(-2
/// pi i k j / n)|, as in RollingVariation::harmonics; n values determine those with 2 k < n. It has a kink at
/// zero, where the slopes given are zero; its square is smooth.
OfPositions harmonic_amplitude(std::span<const double> values, int harmonic);

}  // namespace wheelwright
