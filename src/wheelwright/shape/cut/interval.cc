#include "wheelwright/shape/cut/interval.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheelwright {
namespace {

/// How much smaller the last terms must be than the largest.
constexpr double decay = 0.003;

double last_terms(const Resolution::Samples& series) {
  return std::max(std::abs(series[Resolution::n_samples - 2]), std::abs(series[Resolution::n_samples - 1]));
}

}  // namespace

Interval::Interval(Substitution substitution, double from, double to, double centre, double scale,
                   std::array<double, 2> roots)
    : substitution_(substitution),
      from_(from),
      to_(to),
      centre_(centre),
      scale_(scale),
      roots_(roots),
      first_(coordinate(from)),
      last_(coordinate(to)) {}

Interval Interval::linear(double from, double to) { return {Substitution::linear, from, to, 0, 1}; }

Interval Interval::between_roots(double from, double to) {
  return {Substitution::sine, from, to, 0.5 * (from + to), 0.5 * (to - from), {from, to}};
}

Interval Interval::beyond_root(double from, double to, double root, double partner) {
  return {root <= from ? Substitution::cosh_to_the_right : Substitution::cosh_to_the_left,
          from,
          to,
          root,
          0.5 * std::abs(root - partner),
          {root, partner}};
}

Interval Interval::beyond_logarithm(double from, double to, double root) {
  return {Substitution::power, from, to, root, root <= from ? to - root : from - root};
}

Interval Interval::near(double from, double to, double centre, double scale) {
  return {Substitution::hyperbolic_sine, from, to, centre, scale};
}

std::complex<double> Interval::coordinate(std::complex<double> x) const {
  const std::complex<double> y = (x - centre_) / scale_;
  switch (substitution_) {
    case Substitution::linear:
      return y;
    case Substitution::sine:
      return std::asin(y);
    case Substitution::hyperbolic_sine:
      return std::asinh(y);
    case Substitution::power:
      return std::pow(y, 0.25);
    case Substitution::cosh_to_the_right:
      return 2.0 * std::asinh(std::sqrt(0.5 * y));
    default:
      return -2.0 * std::asinh(std::sqrt(-0.5 * y));
  }
}

double Interval::coordinate(double x) const {
  const double y = (x - centre_) / scale_;
  switch (substitution_) {
    case Substitution::linear:
      return y;
    case Substitution::sine: {  // asin(y), without loss of digits at the ends
      const double from_end =
          0.5 * std::numbers::pi - 2 * std::asin(std::sqrt(0.5 * std::min(x - from_, to_ - x) / scale_));
      return y < 0 ? -from_end : from_end;
    }
    case Substitution::hyperbolic_sine:
      return std::asinh(y);
    case Substitution::power:
      return std::pow(std::max(y, 0.0), 0.25);
    case Substitution::cosh_to_the_right:
      return 2 * std::asinh(std::sqrt(0.5 * std::max(y, 0.0)));
    default:
      return -2 * std::asinh(std::sqrt(0.5 * std::max(-y, 0.0)));
  }
}

Interval::Place Interval::at(double u) const {
  const double t = first_ + (last_ - first_) * u, dt = scale_ * (last_ - first_);
  const auto square = [](double x) { return x * x; };
  switch (substitution_) {
    case Substitution::linear:
      return {from_ + (to_ - from_) * u, dt};
    case Substitution::sine: {
      const double half = 0.25 * std::numbers::pi + 0.5 * t, first = 2 * scale_ * square(std::sin(half)),
                   last = 2 * scale_ * square(std::cos(half));
      return {first < last ? from_ + first : to_ - last, dt * std::cos(t), roots_, {first, last}};
    }
    case Substitution::hyperbolic_sine:
      return {std::clamp(centre_ + scale_ * std::sinh(t), from_, to_), dt * std::cosh(t)};
    case Substitution::power:
      return {std::clamp(centre_ + scale_ * square(square(t)), from_, to_), dt * 4 * t * square(t)};
    default: {
      const double distance = 2 * scale_ * square(std::sinh(0.5 * t));
      const double x =
          substitution_ == Substitution::cosh_to_the_right ? centre_ + distance : centre_ - distance;
      return {
          std::clamp(x, from_, to_), dt * std::abs(std::sinh(t)), roots_, {distance, distance + 2 * scale_}};
    }
  }
}

std::vector<Interval::Place> Interval::places(const GaussRule& rule, double first, double last) const {
  std::vector<Place> result;
  double sum = 0;
  for (size_t q = 0; q < rule.points.size(); ++q) {
    result.push_back(at(first + (last - first) * rule.points[q]));
    result.back().weight *= rule.weights[q];
    sum += result.back().weight;
  }
  const double width = (last < 1 ? at(last).x : to_) - (first > 0 ? at(first).x : from_);
  for (Place& place : result) place.weight *= width / sum;
  return result;
}

double Interval::fraction(double x) const { return (coordinate(x) - first_) / (last_ - first_); }

bool Interval::is_smooth_at(std::complex<double> place) const {
  if (substitution_ == Substitution::hyperbolic_sine)
    return place.real() == centre_ && std::abs(place.imag()) <= scale_;
  return std::any_of(roots_.begin(), roots_.end(), [&](double root) { return place == root; });
}

double Interval::ellipse_through(std::complex<double> place) const {
  const std::complex<double> t = coordinate(place);
  const std::complex<double> u = (2.0 * t - first_ - last_) / (last_ - first_);
  const std::complex<double> w = std::sqrt(u * u - 1.0);
  return std::max(std::abs(u + w), std::abs(u - w));
}

Resolution::Resolution() : rule_(gauss_rule(n_samples)) {
  for (int q = 0; q < n_samples; ++q) {
    const double x = 2 * rule_.points[q] - 1;
    double p = 1, previous = 0;
    for (int k = 0; k < n_samples; ++k) {
      legendre_[k][q] = (2 * k + 1) * rule_.weights[q] * p;
      const double next = ((2 * k + 1) * x * p - k * previous) / (k + 1);
      previous = p;
      p = next;
    }
  }
}

Resolution::Samples Resolution::series(const Samples& f) const {
  Samples result{};
  for (int k = 0; k < n_samples; ++k)
    for (int q = 0; q < n_samples; ++q) result[k] += legendre_[k][q] * f[q];
  return result;
}

bool Resolution::varies_smoothly(const Samples& f, double negligible) const {
  const Samples terms = series(f);
  double largest = 0;
  for (int k = 1; k < n_samples; ++k) largest = std::max(largest, std::abs(terms[k]));
  return last_terms(terms) <= std::max(negligible, decay * largest);
}

bool Resolution::is_smooth(const Samples& f, double negligible) const {
  const Samples terms = series(f);
  return last_terms(terms) <= std::max(negligible, decay * std::abs(terms[0]));
}

}  // namespace wheelwright
