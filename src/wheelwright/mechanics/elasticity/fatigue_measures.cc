#include "wheelwright/mechanics/elasticity/fatigue_measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/mechanics/elasticity/smallest_ball.h"

namespace wheelwright {
namespace {

using Slopes = std::vector<SymmetricTensor>;

double trace(const SymmetricTensor& t) { return t[0] + t[1] + t[2]; }

SymmetricTensor scaled(double factor, SymmetricTensor t) {
  for (double& x : t) x *= factor;
  return t;
}

void add(double factor, const SymmetricTensor& t, SymmetricTensor& sum) {
  for (std::size_t k = 0; k < t.size(); ++k) sum[k] += factor * t[k];
}

/// An orthonormal basis of the deviators: |coordinates|^2 = s:s of the deviator s of a tensor.
SmallestBall::Point deviator_coordinates(const SymmetricTensor& t) {
  const double s2 = std::sqrt(2.0), s6 = std::sqrt(6.0);
  return {(t[0] - t[1]) / s2, (2 * t[2] - t[0] - t[1]) / s6, s2 * t[3], s2 * t[4], s2 * t[5]};
}

/// The derivative with respect to the tensor from that with respect to those coordinates.
SymmetricTensor by_tensor(const SmallestBall::Point& x) {
  const double s2 = std::sqrt(2.0), s6 = std::sqrt(6.0);
  return {x[0] / s2 - x[1] / s6, -x[0] / s2 - x[1] / s6, 2 * x[1] / s6, s2 * x[2], s2 * x[3], s2 * x[4]};
}

/// The deviator of these coordinates.
SymmetricTensor deviator(const SmallestBall::Point& x) {
  SymmetricTensor t = by_tensor(x);
  for (int k = 3; k < 6; ++k) t[k] /= 2;
  return t;
}

SmallestBall ball_of_deviators(TensorHistory stresses) {
  std::vector<SmallestBall::Point> points;
  for (const SymmetricTensor& stress : stresses) points.push_back(deviator_coordinates(stress));
  return SmallestBall(points);
}

constexpr SymmetricTensor unit{1, 1, 1, 0, 0, 0};

template <class Function>
std::vector<double> of_each(TensorHistory history, Function function) {
  std::vector<double> values;
  for (const SymmetricTensor& t : history) values.push_back(function(t));
  return values;
}

// Smooth functions of eigenvalues, and their derivatives.

struct OfPrincipal {
  double value;
  std::array<double, 3> slopes;
};

constexpr int exponent = 16;

/// (sum of the positive e_i^16)^(1/16).
OfPrincipal smooth_largest(const std::array<double, 3>& e) {
  const double most = e[0];
  if (most <= 0) return {0, {}};
  double sum = 0;
  for (const double x : e) sum += std::pow(std::max(0.0, x / most), exponent);
  const double norm = std::pow(sum, 1.0 / exponent);
  OfPrincipal result{most * norm, {}};
  for (int i = 0; i < 3; ++i) result.slopes[i] = std::pow(std::max(0.0, e[i] / result.value), exponent - 1);
  return result;
}

/// Half of (sum of (e_i - e_k)^16 / 2)^(1/16) over the pairs: (e_1 - e_3) / 2 if two of them are equal.
OfPrincipal smooth_shear(const std::array<double, 3>& e) {
  const double most = e[0] - e[2];
  if (most == 0) return {0, {}};
  const double differences[3] = {(e[0] - e[1]) / most, (e[1] - e[2]) / most, 1};
  double sum = 0;
  for (const double x : differences) sum += 0.5 * std::pow(x, exponent);
  const double norm = std::pow(sum, 1.0 / exponent);
  const auto slope = [&](double x) { return 0.25 * std::pow(x / norm, exponent - 1); };
  const double a = slope(differences[0]), b = slope(differences[1]), c = slope(differences[2]);
  return {0.5 * most * norm, {a + c, b - a, -b - c}};
}

/// factor times the derivative of such a function with respect to the tensor.
SymmetricTensor by_tensor(double factor, const OfPrincipal& function, const SymmetricTensor& t) {
  const auto axes = principal_axes(t);
  SymmetricTensor result{};
  for (int i = 0; i < 3; ++i) add(factor * function.slopes[i], slope_along(axes[i]), result);
  return result;
}

SymmetricTensor difference(SymmetricTensor a, const SymmetricTensor& b) {
  add(-1, b, a);
  return a;
}

/// max x_j + T log sum_j exp((x_j - max) / T) with T a twentieth of the quadratic mean of x, and its
/// derivatives.
struct SmoothMaximum {
  double value;
  std::vector<double> slopes;
};
SmoothMaximum smooth_maximum(const std::vector<double>& x) {
  constexpr double softness = 0.05;
  const auto n = static_cast<double>(x.size());
  const double size = std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0) / n),
               temperature = softness * size, most = std::ranges::max(x);
  SmoothMaximum result{most, std::vector<double>(x.size(), 0.0)};
  if (size == 0) return result;
  double sum = 0, mean = 0;
  for (std::size_t j = 0; j < x.size(); ++j) sum += result.slopes[j] = std::exp((x[j] - most) / temperature);
  for (std::size_t j = 0; j < x.size(); ++j) mean += (result.slopes[j] /= sum) * x[j];
  result.value += temperature * std::log(sum);
  const double by_temperature = (result.value - mean) / temperature;
  for (std::size_t j = 0; j < x.size(); ++j)
    result.slopes[j] += by_temperature * softness * x[j] / (n * size);
  return result;
}

/// a / (1 - m / R_m), and its derivatives.
struct GoodmanValue {
  double value, by_amplitude, by_mean;
};
GoodmanValue goodman(double amplitude, double mean, double ultimate_strength) {
  constexpr double most = 0.999;
  const double share = std::clamp(mean / ultimate_strength, 0.0, most), factor = 1 / (1 - share);
  const bool counts = share > 0 && share < most;
  return {amplitude * factor, factor, counts ? amplitude * factor * factor / ultimate_strength : 0};
}

/// sqrt(3 J2)_a by the radius of the ball of the deviators.
const double amplitude_by_radius = std::sqrt(1.5);

std::vector<double> negative(std::vector<double> x) {
  for (double& y : x) y = -y;
  return x;
}

}  // namespace

double LargestPrincipal::value(TensorHistory strains) const {
  return std::ranges::max(of_each(strains, [](const SymmetricTensor& t) { return principal_values(t)[0]; }));
}

std::vector<double> LargestPrincipal::samples(TensorHistory strains) const {
  return of_each(strains, [](const SymmetricTensor& t) { return smooth_largest(principal_values(t)).value; });
}

Slopes LargestPrincipal::slopes(TensorHistory strains, std::span<const double> factors) const {
  Slopes result(strains.size(), SymmetricTensor{});
  for (std::size_t j = 0; j < strains.size(); ++j)
    if (factors[j] != 0)
      result[j] = by_tensor(factors[j], smooth_largest(principal_values(strains[j])), strains[j]);
  return result;
}

double Crossland::value(TensorHistory stresses) const { return std::ranges::max(samples(stresses)); }

std::vector<double> Crossland::samples(TensorHistory stresses) const {
  const double amplitude = ball_of_deviators(stresses).radius() / std::sqrt(2.0);
  return of_each(stresses,
                 [&](const SymmetricTensor& t) { return amplitude + pressure_factor * trace(t) / 3; });
}

Slopes Crossland::slopes(TensorHistory stresses, std::span<const double> factors) const {
  Slopes result;
  for (const double factor : factors) result.push_back(scaled(factor * pressure_factor / 3, unit));
  const double of_radius = std::accumulate(factors.begin(), factors.end(), 0.0) / std::sqrt(2.0);
  for (const auto& [sample, slope] : ball_of_deviators(stresses).slopes_of_radius())
    add(of_radius, by_tensor(slope), result[sample]);
  return result;
}

double DangVan::value(TensorHistory stresses) const {
  const SymmetricTensor center = deviator(ball_of_deviators(stresses).center());
  return std::ranges::max(of_each(stresses, [&](const SymmetricTensor& stress) {
    const auto principal = principal_values(difference(stress, center));
    return 0.5 * (principal[0] - principal[2]) + pressure_factor * trace(stress) / 3;
  }));
}

std::vector<double> DangVan::samples(TensorHistory stresses) const {
  const SymmetricTensor center = deviator(ball_of_deviators(stresses).center());
  return of_each(stresses, [&](const SymmetricTensor& stress) {
    return smooth_shear(principal_values(difference(stress, center))).value +
           pressure_factor * trace(stress) / 3;
  });
}

Slopes DangVan::slopes(TensorHistory stresses, std::span<const double> factors) const {
  const SmallestBall ball = ball_of_deviators(stresses);
  const SymmetricTensor center = deviator(ball.center());
  Slopes result(stresses.size(), SymmetricTensor{});
  SymmetricTensor all_shears{};
  for (std::size_t j = 0; j < stresses.size(); ++j) {
    if (factors[j] == 0) continue;
    const SymmetricTensor about_center = difference(stresses[j], center);
    const SymmetricTensor shear =
        by_tensor(factors[j], smooth_shear(principal_values(about_center)), about_center);  // a deviator
    add(1, shear, all_shears);
    add(1, shear, result[j]);
    add(factors[j] * pressure_factor / 3, unit, result[j]);
  }
  for (int k = 3; k < 6; ++k) all_shears[k] /= 2;
  for (const auto& [sample, slope] : ball.slopes_of_center(deviator_coordinates(all_shears)))
    add(-1, by_tensor(slope), result[sample]);
  return result;
}

double Goodman::value(TensorHistory stresses) const {
  const auto [low, high] = std::ranges::minmax(of_each(stresses, trace));
  return goodman(amplitude_by_radius * ball_of_deviators(stresses).radius(), 0.5 * (low + high),
                 ultimate_strength)
      .value;
}

std::vector<double> Goodman::samples(TensorHistory stresses) const {
  const std::vector<double> traces = of_each(stresses, trace);
  const double mean = 0.5 * (smooth_maximum(traces).value - smooth_maximum(negative(traces)).value);
  const double amplitude = amplitude_by_radius * ball_of_deviators(stresses).radius();
  return std::vector<double>(stresses.size(), goodman(amplitude, mean, ultimate_strength).value);
}

Slopes Goodman::slopes(TensorHistory stresses, std::span<const double> factors) const {
  const std::vector<double> traces = of_each(stresses, trace);
  const SmoothMaximum high = smooth_maximum(traces), minus_low = smooth_maximum(negative(traces));
  const SmallestBall ball = ball_of_deviators(stresses);
  const GoodmanValue measure =
      goodman(amplitude_by_radius * ball.radius(), 0.5 * (high.value - minus_low.value), ultimate_strength);
  const double factor = std::accumulate(factors.begin(), factors.end(), 0.0);
  Slopes result;
  for (std::size_t j = 0; j < traces.size(); ++j)
    result.push_back(scaled(0.5 * factor * measure.by_mean * (high.slopes[j] + minus_low.slopes[j]), unit));
  for (const auto& [sample, slope] : ball.slopes_of_radius())
    add(factor * measure.by_amplitude * amplitude_by_radius, by_tensor(slope), result[sample]);
  return result;
}

}  // namespace wheelwright
