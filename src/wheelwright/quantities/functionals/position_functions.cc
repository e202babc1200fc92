#include "wheelwright/quantities/functionals/position_functions.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace wheelwright {
namespace {

/// In units of the inverse range of the values: the minimum has e^-10 of the weight of the maximum.
constexpr double relative_sharpness = 10;

OfPositions extreme(std::span<const double> values, double sign) {
  const auto [minimum, maximum] = std::ranges::minmax(values);
  OfPositions result = maximum > minimum
                           ? smooth_maximum(values, sign * relative_sharpness / (maximum - minimum))
                           : mean_of(values);
  result.value = sign > 0 ? maximum : minimum;
  return result;
}

}  // namespace

OfPositions mean_of(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  return {std::accumulate(values.begin(), values.end(), 0.0) / n, std::vector<double>(values.size(), 1 / n)};
}

OfPositions smooth_maximum(std::span<const double> values, double sharpness) {
  const auto [minimum, maximum] = std::ranges::minmax(values);
  const double extreme = sharpness > 0 ? maximum : minimum;
  OfPositions result{0, {}};
  for (const double x : values) result.slopes.push_back(std::exp(sharpness * (x - extreme)));
  const double sum = std::accumulate(result.slopes.begin(), result.slopes.end(), 0.0);
  result.value = extreme + std::log(sum / static_cast<double>(values.size())) / sharpness;
  for (double& slope : result.slopes) slope /= sum;
  return result;
}

OfPositions maximum_of(std::span<const double> values) { return extreme(values, 1); }

OfPositions minimum_of(std::span<const double> values) { return extreme(values, -1); }

OfPositions peak_to_peak_of(std::span<const double> values) {
  OfPositions result = maximum_of(values);
  const OfPositions minimum = minimum_of(values);
  result.value -= minimum.value;
  for (std::size_t i = 0; i < result.slopes.size(); ++i) result.slopes[i] -= minimum.slopes[i];
  return result;
}

OfPositions harmonic_amplitude(std::span<const double> values, int harmonic) {
  const int n = static_cast<int>(values.size());
  const double mean = mean_of(values).value;
  const auto wave = [&](int j) {
    return std::polar(1.0, -2 * std::numbers::pi * (static_cast<long>(harmonic) * j % n) / n);
  };
  std::complex<double> sum = 0;
  for (int j = 0; j < n; ++j) sum += (values[j] - mean) * wave(j);
  const double size = std::abs(sum);
  OfPositions result{2 * size / n, {}};
  for (int j = 0; j < n; ++j)
    result.slopes.push_back(size > 0 ? 2 * std::real(std::conj(sum) * wave(j)) / (size * n) : 0);
  return result;
}

}  // namespace wheelwright
