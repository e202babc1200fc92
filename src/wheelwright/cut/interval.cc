#include "wheelwright/cut/interval.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// How much smaller the last terms must be than the largest.
constexpr double decay = 0.003;

/// With a branch point on the ellipse around [-1, 1] whose half axes add up to this, the error of the Gauss
/// rule falls by its square with each point.
constexpr double nearest_branch_point = 5;

/// The same for poles, most of which are weak or belong to zeros outside of the square: samples show whether
/// they matter, if they are not nearer than this.
constexpr double nearest_pole = 1.3;

double last_terms(const Resolution::Samples& series) {
  return std::max(std::abs(series[Resolution::n_samples - 2]), std::abs(series[Resolution::n_samples - 1]));
}

}  // namespace

Interval::Place Interval::at(double u) const {
  const double s = first + (last - first) * u, t = (1 - last) + (last - first) * (1 - u);  // s + t = 1
  double fraction = s, rest = t, slope = 1;
  if (root_at_from && root_at_to) {
    fraction = s * s * (3 - 2 * s);
    rest = t * t * (3 - 2 * t);
    slope = 6 * s * t;
  } else if (root_at_from) {
    fraction = s * s;
    rest = t * (1 + s);
    slope = 2 * s;
  } else if (root_at_to) {
    fraction = s * (1 + t);
    rest = t * t;
    slope = 2 * t;
  }
  const double width = to - from;
  return {fraction < 0.5 ? from + width * fraction : to - width * rest, width * slope * (last - first),
          fraction, rest};
}

std::array<Interval, 2> Interval::halves() const {
  std::array<Interval, 2> result{*this, *this};
  result[0].last = result[1].first = 0.5 * (first + last);
  return result;
}

std::complex<double> Interval::substituted(std::complex<double> place) const {
  const std::complex<double> x = (place - from) / (to - from);
  if (root_at_from && root_at_to) return 0.5 - std::sin(std::asin(1.0 - 2.0 * x) / 3.0);
  if (root_at_from) return std::sqrt(x);
  return root_at_to ? 1.0 - std::sqrt(1.0 - x) : x;
}

/// Sum of the half axes of the ellipse through a place, around the part that is meant as [-1, 1].
double Interval::ellipse_through(std::complex<double> place) const {
  const std::complex<double> s = substituted(place);
  const std::complex<double> u = (2.0 * s - first - last) / (last - first);
  const std::complex<double> w = std::sqrt(u * u - 1.0);
  return std::max(std::abs(u + w), std::abs(u - w));
}

bool Interval::is_far_from_branch_points(std::span<const std::complex<double>> places) const {
  const auto closest_to = [&](double end) {
    return std::min_element(places.begin(), places.end(),
                            [&](auto a, auto b) { return std::abs(a - end) < std::abs(b - end); });
  };
  const auto at_from = root_at_from ? closest_to(from) : places.end();
  const auto at_to = root_at_to ? closest_to(to) : places.end();
  for (auto place = places.begin(); place != places.end(); ++place)
    if (place != at_from && place != at_to && ellipse_through(*place) < nearest_branch_point) return false;
  return true;
}

bool Interval::is_far_from_pole(std::complex<double> place) const {
  const bool is_within = std::abs(place.imag()) < 1e-6 && place.real() > from && place.real() < to;
  return is_within || ellipse_through(place) >= nearest_pole;
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

bool Resolution::is_smooth(const Samples& f) const {
  const Samples terms = series(f);
  return last_terms(terms) <= decay * std::abs(terms[0]);
}

}  // namespace wheelwright
