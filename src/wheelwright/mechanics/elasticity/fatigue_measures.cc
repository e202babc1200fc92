#include "wheelwright/mechanics/elasticity/fatigue_measures.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/mechanics/elasticity/smallest_ball.h"

namespace wheelwright {
namespace {

double trace(const SymmetricTensor& t) { return t[0] + t[1] + t[2]; }

/// The largest value of function(sample), and the first sample that has it.
template <class Function>
std::pair<double, int> largest(std::span<const SymmetricTensor> history, Function function) {
  std::pair<double, int> result{function(history[0]), 0};
  for (std::size_t j = 1; j < history.size(); ++j)
    if (const double value = function(history[j]); value > result.first)
      result = {value, static_cast<int>(j)};
  return result;
}

SymmetricTensor scaled(double factor, SymmetricTensor t) {
  for (double& x : t) x *= factor;
  return t;
}

SymmetricTensor sum(SymmetricTensor a, const SymmetricTensor& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
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

SmallestBall ball_of_deviators(std::span<const SymmetricTensor> stresses) {
  std::vector<SmallestBall::Point> points;
  for (const SymmetricTensor& stress : stresses) points.push_back(deviator_coordinates(stress));
  return SmallestBall(points);
}

SymmetricTensor slope_of_trace(double factor) { return {factor, factor, factor, 0, 0, 0}; }

double squared_von_mises(const SymmetricTensor& t) {
  const auto x = deviator_coordinates(t);
  double square = 0;
  for (const double y : x) square += y * y;
  return 1.5 * square;
}

double signed_von_mises(const SymmetricTensor& t) {
  return std::copysign(std::sqrt(squared_von_mises(t)), trace(t));
}

SymmetricTensor slope_of_signed_von_mises(const SymmetricTensor& t) {
  const double value = signed_von_mises(t);
  return value == 0 ? SymmetricTensor{} : scaled(1.5 / value, by_tensor(deviator_coordinates(t)));
}

}  // namespace

HistoryMeasure largest_principal(std::span<const SymmetricTensor> strains) {
  const auto [value, at] = largest(strains, [](const SymmetricTensor& t) { return principal_values(t)[0]; });
  return {value, {{at, slope_along(principal_axes(strains[at])[0])}}};
}

HistoryMeasure crossland(std::span<const SymmetricTensor> stresses, double pressure_factor) {
  const SmallestBall ball = ball_of_deviators(stresses);
  const auto [pressure, at] = largest(stresses, trace);
  HistoryMeasure result{(ball.radius() / std::sqrt(2.0)) + pressure_factor * pressure / 3,
                        {{at, slope_of_trace(pressure_factor / 3)}}};
  for (const auto& [sample, slope] : ball.slopes_of_radius())
    result.slopes.push_back({sample, scaled(1 / std::sqrt(2.0), by_tensor(slope))});
  return result;
}

HistoryMeasure dang_van(std::span<const SymmetricTensor> stresses, double pressure_factor) {
  const SmallestBall ball = ball_of_deviators(stresses);
  const SymmetricTensor center = scaled(-1, deviator(ball.center()));
  const auto [value, at] = largest(stresses, [&](const SymmetricTensor& stress) {
    const auto principal = principal_values(sum(stress, center));
    return 0.5 * (principal[0] - principal[2]) + pressure_factor * trace(stress) / 3;
  });
  const auto axes = principal_axes(sum(stresses[at], center));
  const SymmetricTensor shear =
      sum(scaled(0.5, slope_along(axes[0])), scaled(-0.5, slope_along(axes[2])));  // a deviator
  HistoryMeasure result{value, {{at, sum(shear, slope_of_trace(pressure_factor / 3))}}};
  SymmetricTensor minus_shear = scaled(-1, shear);
  for (int k = 3; k < 6; ++k) minus_shear[k] /= 2;
  for (const auto& [sample, slope] : ball.slopes_of_center(deviator_coordinates(minus_shear)))
    result.slopes.push_back({sample, by_tensor(slope)});
  return result;
}

HistoryMeasure goodman(std::span<const SymmetricTensor> stresses, double ultimate_strength) {
  constexpr double most = 0.999;
  const auto [high, at_high] = largest(stresses, signed_von_mises);
  const auto [minus_low, at_low] = largest(stresses, [](const auto& t) { return -signed_von_mises(t); });
  const double amplitude = 0.5 * (high + minus_low), mean = 0.5 * (high - minus_low);
  const double share = std::clamp(mean / ultimate_strength, 0.0, most), factor = 1 / (1 - share);
  const double by_mean = share > 0 && share < most ? amplitude * factor * factor / ultimate_strength : 0;
  return {amplitude * factor,
          {{at_high, scaled(0.5 * (factor + by_mean), slope_of_signed_von_mises(stresses[at_high]))},
           {at_low, scaled(0.5 * (by_mean - factor), slope_of_signed_von_mises(stresses[at_low]))}}};
}

}  // namespace wheelwright
