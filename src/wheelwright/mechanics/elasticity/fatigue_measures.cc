#include "wheelwright/mechanics/elasticity/fatigue_measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "wheelwright/base/integer_power.h"
#include "wheelwright/mechanics/elasticity/smooth_ball.h"

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

/// An orthonormal basis of the deviators: |coordinates|^2 = s:s of the deviator s of a tensor. The last two
/// are 0 in the plane of a wheel.
SmallestBall::Point deviator_coordinates(const SymmetricTensor& t) {
  const double s2 = std::sqrt(2.0), s6 = std::sqrt(6.0);
  return {(t[0] - t[1]) / s2, (2 * t[2] - t[0] - t[1]) / s6, s2 * t[5], s2 * t[4], s2 * t[3]};
}

/// The derivative with respect to the tensor from that with respect to those coordinates.
SymmetricTensor by_tensor(const SmallestBall::Point& x) {
  const double s2 = std::sqrt(2.0), s6 = std::sqrt(6.0);
  return {x[0] / s2 - x[1] / s6, -x[0] / s2 - x[1] / s6, 2 * x[1] / s6, s2 * x[4], s2 * x[3], s2 * x[2]};
}

/// Adds derivatives with respect to the coordinates of all tensors.
void add(double factor, const std::vector<SmallestBall::Point>& by_coordinates, Slopes& sum) {
  for (std::size_t j = 0; j < sum.size(); ++j) add(factor, by_tensor(by_coordinates[j]), sum[j]);
}

/// The deviator of these coordinates.
SymmetricTensor deviator(const SmallestBall::Point& x) {
  SymmetricTensor t = by_tensor(x);
  for (int k = 3; k < 6; ++k) t[k] /= 2;
  return t;
}

/// sqrt(t:t), which no eigenvalue exceeds.
double size(const SymmetricTensor& t) {
  return std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + 2 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]));
}

constexpr SymmetricTensor unit{1, 1, 1, 0, 0, 0};

template <class Function>
auto of_each(TensorHistory history, Function function) {
  std::vector<decltype(function(history[0]))> values;
  for (const SymmetricTensor& t : history) values.push_back(function(t));
  return values;
}

// Smooth functions of eigenvalues, and their derivatives.

struct OfPrincipal {
  double value;
  std::array<double, 3> slopes;
};

constexpr int exponent = 16;

double sixteenth_root(double x) { return std::sqrt(std::sqrt(std::sqrt(std::sqrt(x)))); }

/// (sum of the positive e_i^16)^(1/16).
OfPrincipal smooth_largest(const std::array<double, 3>& e) {
  const double most = e[0];
  if (most <= 0) return {0, {}};
  double sum = 0;
  for (const double x : e) sum += integer_power(std::max(0.0, x / most), exponent);
  const double norm = sixteenth_root(sum);
  OfPrincipal result{most * norm, {}};
  for (int i = 0; i < 3; ++i)
    result.slopes[i] = integer_power(std::max(0.0, e[i] / result.value), exponent - 1);
  return result;
}

/// Half of (sum of (e_i - e_k)^16 / 2)^(1/16) over the pairs: (e_1 - e_3) / 2 if two of them are equal.
OfPrincipal smooth_shear(const std::array<double, 3>& e) {
  const double most = e[0] - e[2];
  if (most == 0) return {0, {}};
  const double differences[3] = {(e[0] - e[1]) / most, (e[1] - e[2]) / most, 1};
  double sum = 0;
  for (const double x : differences) sum += 0.5 * integer_power(x, exponent);
  const double norm = sixteenth_root(sum);
  const auto slope = [&](double x) { return 0.25 * integer_power(x / norm, exponent - 1); };
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

/// The smallest ball around the path of the deviators. It is found only where its radius may matter: where
/// the measure may reach a least one.
class DeviatorBall {
 public:
  /// `measure(radius)`: a bound of the measure by a bound of the radius.
  template <class Bound>
  DeviatorBall(TensorHistory stresses, double least, const Bound& measure) {
    for (const SymmetricTensor& stress : stresses) points_.push_back(deviator_coordinates(stress));
    const double most = std::pow(static_cast<double>(points_.size()), 1.0 / SmoothBall::exponent);
    if (least <= 0 || measure(most * radius_about_mean(points_)) >= least) ball_.emplace(points_);
  }

  bool matters() const { return ball_.has_value(); }
  const SmallestBall& smallest() const { return *ball_; }
  /// The one of the samples. Computed once it is asked for.
  const SmoothBall& smooth() const {
    if (!smooth_) smooth_.emplace(points_, *ball_);
    return *smooth_;
  }

 private:
  static double radius_about_mean(const std::vector<SmallestBall::Point>& points) {
    SmallestBall::Point mean{};
    for (const auto& point : points)
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += point[k] / static_cast<double>(points.size());
    double square = 0;
    for (const auto& point : points) {
      double distance = 0;
      for (std::size_t k = 0; k < mean.size(); ++k) distance += (point[k] - mean[k]) * (point[k] - mean[k]);
      square = std::max(square, distance);
    }
    return std::sqrt(square);
  }

  std::vector<SmallestBall::Point> points_;
  std::optional<SmallestBall> ball_;
  mutable std::optional<SmoothBall> smooth_;
};

/// sqrt(3 J2)_a by the radius of the ball of the deviators.
const double amplitude_by_radius = std::sqrt(1.5);

std::vector<double> negative(std::vector<double> x) {
  for (double& y : x) y = -y;
  return x;
}

class PrincipalHistory : public MeasuredHistory {
 public:
  PrincipalHistory(TensorHistory strains, double least) : strains_(strains), least_(least) {}

  double value() const override {
    double largest = -INFINITY;
    for (const SymmetricTensor& strain : strains_)
      if (size(strain) >= std::max(largest, least_)) largest = std::max(largest, principal_values(strain)[0]);
    return std::isfinite(largest) ? largest : 0;
  }

  std::vector<double> samples() const override {
    const double most = sixteenth_root(3);  // of a norm by the largest eigenvalue
    return of_each(strains_, [&](const SymmetricTensor& t) {
      return most * size(t) < least_ ? 0 : smooth_largest(principal_values(t)).value;
    });
  }

  Slopes slopes(std::span<const double> factors) const override {
    Slopes result(strains_.size(), SymmetricTensor{});
    for (std::size_t j = 0; j < strains_.size(); ++j)
      if (factors[j] != 0)
        result[j] = by_tensor(factors[j], smooth_largest(principal_values(strains_[j])), strains_[j]);
    return result;
  }

 private:
  TensorHistory strains_;
  double least_;
};

/// The radius of the ball as a shear stress, and alpha max p: Crossland's measure, and a bound of Dang Van's.
double with_largest_pressure(double radius, double pressure_factor, TensorHistory stresses) {
  return radius / std::sqrt(2.0) + pressure_factor * std::ranges::max(of_each(stresses, trace)) / 3;
}

class CrosslandHistory : public MeasuredHistory {
 public:
  CrosslandHistory(double pressure_factor, TensorHistory stresses, double least)
      : pressure_factor_(pressure_factor), stresses_(stresses), ball_(stresses, least, [&](double radius) {
          return with_largest_pressure(radius, pressure_factor, stresses);
        }) {}

  double value() const override {
    if (!ball_.matters()) return 0;
    return with_largest_pressure(ball_.smallest().radius(), pressure_factor_, stresses_);
  }

  std::vector<double> samples() const override {
    if (!ball_.matters()) return std::vector<double>(stresses_.size(), 0.0);
    const double amplitude = ball_.smooth().radius() / std::sqrt(2.0);
    return of_each(stresses_,
                   [&](const SymmetricTensor& t) { return amplitude + pressure_factor_ * trace(t) / 3; });
  }

  Slopes slopes(std::span<const double> factors) const override {
    Slopes result(stresses_.size(), SymmetricTensor{});
    if (!ball_.matters()) return result;
    for (std::size_t j = 0; j < factors.size(); ++j)
      result[j] = scaled(factors[j] * pressure_factor_ / 3, unit);
    const double of_radius = std::accumulate(factors.begin(), factors.end(), 0.0) / std::sqrt(2.0);
    add(of_radius, ball_.smooth().slopes_of_radius(), result);
    return result;
  }

 private:
  double pressure_factor_;
  TensorHistory stresses_;
  DeviatorBall ball_;
};

class DangVanHistory : public MeasuredHistory {
 public:
  DangVanHistory(double pressure_factor, TensorHistory stresses, double least)
      : pressure_factor_(pressure_factor),
        stresses_(stresses),
        least_(least),
        // The shear stress about the center is at most the radius by sqrt(2).
        ball_(stresses, least,
              [&](double radius) { return with_largest_pressure(radius, pressure_factor, stresses); }) {}

  double value() const override {
    if (!ball_.matters()) return 0;
    double largest = -INFINITY;
    for (const SymmetricTensor& stress : about(ball_.smallest().center()))
      if (bound(stress) >= std::max(largest, least_)) {
        const auto principal = principal_values(stress);
        largest = std::max(largest, 0.5 * (principal[0] - principal[2]) + of_pressure(stress));
      }
    return std::isfinite(largest) ? largest : 0;
  }

  std::vector<double> samples() const override {
    if (!ball_.matters()) return std::vector<double>(stresses_.size(), 0.0);
    return of_each(about(ball_.smooth().center()), [&](const SymmetricTensor& stress) {
      return least_ > 0 && bound(stress) < least_
                 ? 0
                 : smooth_shear(principal_values(stress)).value + of_pressure(stress);
    });
  }

  Slopes slopes(std::span<const double> factors) const override {
    Slopes result(stresses_.size(), SymmetricTensor{});
    if (!ball_.matters()) return result;
    SymmetricTensor all_shears{};
    const Slopes about_center = about(ball_.smooth().center());
    for (std::size_t j = 0; j < stresses_.size(); ++j) {
      if (factors[j] == 0) continue;
      const SymmetricTensor shear = by_tensor(factors[j], smooth_shear(principal_values(about_center[j])),
                                              about_center[j]);  // a deviator
      add(1, shear, all_shears);
      add(1, shear, result[j]);
      add(factors[j] * pressure_factor_ / 3, unit, result[j]);
    }
    for (int k = 3; k < 6; ++k) all_shears[k] /= 2;
    add(-1, ball_.smooth().slopes_of_center(deviator_coordinates(all_shears)), result);
    return result;
  }

 private:
  std::vector<SymmetricTensor> about(const SmallestBall::Point& center) const {
    const SymmetricTensor tensor = deviator(center);
    return of_each(stresses_, [&](const SymmetricTensor& stress) { return difference(stress, tensor); });
  }

  // Both take the stress less the center of the ball, s - s* + p I.
  double of_pressure(const SymmetricTensor& about_center) const {
    return pressure_factor_ * trace(about_center) / 3;
  }
  double bound(const SymmetricTensor& about_center) const {
    return size(about_center) / std::sqrt(2.0) + of_pressure(about_center);
  }

  double pressure_factor_;
  TensorHistory stresses_;
  double least_;
  DeviatorBall ball_;
};

class GoodmanHistory : public MeasuredHistory {
 public:
  GoodmanHistory(double ultimate_strength, TensorHistory stresses, double least)
      : ultimate_strength_(ultimate_strength),
        traces_(of_each(stresses, trace)),
        ball_(stresses, least, [&](double radius) {
          // Its smooth maximum and minimum leave the range of the trace by less than half of its size.
          const double most = 1.5 * std::ranges::max(of_each(stresses, [](const SymmetricTensor& t) {
                                return std::abs(trace(t));
                              }));
          return goodman(amplitude_by_radius * radius, most, ultimate_strength).value;
        }) {}

  double value() const override {
    if (!ball_.matters()) return 0;
    const auto [low, high] = std::ranges::minmax(traces_);
    return of(ball_.smallest().radius(), 0.5 * (low + high)).value;
  }

  std::vector<double> samples() const override {
    if (!ball_.matters()) return std::vector<double>(traces_.size(), 0.0);
    const double mean = 0.5 * (smooth_maximum(traces_).value - smooth_maximum(negative(traces_)).value);
    return std::vector<double>(traces_.size(), of(ball_.smooth().radius(), mean).value);
  }

  Slopes slopes(std::span<const double> factors) const override {
    Slopes result(traces_.size(), SymmetricTensor{});
    if (!ball_.matters()) return result;
    const SmoothMaximum high = smooth_maximum(traces_), minus_low = smooth_maximum(negative(traces_));
    const GoodmanValue measure = of(ball_.smooth().radius(), 0.5 * (high.value - minus_low.value));
    const double factor = std::accumulate(factors.begin(), factors.end(), 0.0);
    for (std::size_t j = 0; j < traces_.size(); ++j)
      result[j] = scaled(0.5 * factor * measure.by_mean * (high.slopes[j] + minus_low.slopes[j]), unit);
    add(factor * measure.by_amplitude * amplitude_by_radius, ball_.smooth().slopes_of_radius(), result);
    return result;
  }

 private:
  GoodmanValue of(double radius, double mean) const {
    return goodman(amplitude_by_radius * radius, mean, ultimate_strength_);
  }

  double ultimate_strength_;
  std::vector<double> traces_;
  DeviatorBall ball_;
};

}  // namespace

std::unique_ptr<const MeasuredHistory> LargestPrincipal::of(TensorHistory strains, double least) const {
  return std::make_unique<PrincipalHistory>(strains, least);
}

std::unique_ptr<const MeasuredHistory> Crossland::of(TensorHistory stresses, double least) const {
  return std::make_unique<CrosslandHistory>(pressure_factor, stresses, least);
}

std::unique_ptr<const MeasuredHistory> DangVan::of(TensorHistory stresses, double least) const {
  return std::make_unique<DangVanHistory>(pressure_factor, stresses, least);
}

std::unique_ptr<const MeasuredHistory> Goodman::of(TensorHistory stresses, double least) const {
  return std::make_unique<GoodmanHistory>(ultimate_strength, stresses, least);
}

}  // namespace wheelwright
