#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {

/// An interval of integration with a substitution x(t) that makes the integrand smooth at branch points of
/// square roots, or close to singular points in the complex plane. On the interval, t is first + (last -
/// first) u with u in [0, 1].
class Interval {
 public:
  /// x = t.
  static Interval linear(double from, double to);
  /// Square roots vanish at both ends: x = centre + scale sin(t).
  static Interval between_roots(double from, double to);
  /// A square root vanishes at `root`, which is not within the interval, and perhaps another one at
  /// `partner` behind it: x = centre +- scale cosh(t).
  static Interval beyond_root(double from, double to, double root, double partner);
  /// A logarithm at an end, `root`: x = root +- width t^4.
  static Interval beyond_logarithm(double from, double to, double root);
  /// Singular points at centre +- i scale: x = centre + scale sinh(t).
  static Interval near(double from, double to, double centre, double scale);

  double from() const { return from_; }
  double to() const { return to_; }
  double width() const { return to_ - from_; }

  /// The range of t, if x is a trigonometric or hyperbolic function of it.
  double span() const {
    return substitution_ == Substitution::linear || substitution_ == Substitution::power ? 0 : last_ - first_;
  }

  struct Place {
    double x, weight;  ///< weight: dx/du, or that of a quadrature point
    std::array<double, 2> roots{NAN, NAN};
    std::array<double, 2> to_roots{};  ///< distances, to the last digit
  };
  Place at(double u) const;
  /// The points of a rule on [0, 1], on the part of the interval between two values of u. Their weights add
  /// up to the part's width.
  std::vector<Place> places(const GaussRule& rule, double first = 0, double last = 1) const;
  /// u of a place in the interval.
  double fraction(double x) const;

  /// Whether a singular point is one of those handled by the substitution.
  bool is_smooth_at(std::complex<double> place) const;

  /// Sum of the half axes of the ellipse through a singular point, around the interval of t as [-1, 1]: by
  /// its square the error of a Gauss rule falls with every point.
  double ellipse_through(std::complex<double> place) const;

 private:
  enum class Substitution { linear, sine, hyperbolic_sine, cosh_to_the_right, cosh_to_the_left, power };
  Interval(Substitution substitution, double from, double to, double centre, double scale,
           std::array<double, 2> roots = {NAN, NAN});
  /// t at x.
  double coordinate(double x) const;
  std::complex<double> coordinate(std::complex<double> x) const;

  Substitution substitution_;
  double from_, to_, centre_, scale_;
  std::array<double, 2> roots_;  ///< of square roots that are smooth after the substitution
  double first_, last_;
};

/// Decides from samples of a function whether a Gauss rule integrates it accurately: whether its Legendre
/// series on the interval decays.
class Resolution {
 public:
  static constexpr int n_samples = 7;
  using Samples = std::array<double, n_samples>;

  Resolution();

  /// Where to sample, in [0, 1].
  const std::vector<double>& places() const { return rule_.points; }

  /// Whether the last terms are small compared with the nonconstant ones, or below `negligible`.
  bool varies_smoothly(const Samples& f, double negligible) const;
  /// Whether the last terms are small compared with the mean, or below `negligible`.
  bool is_smooth(const Samples& f, double negligible) const;

 private:
  Samples series(const Samples& f) const;

  GaussRule rule_;
  std::array<Samples, n_samples> legendre_;  ///< [k][q]: what sample q adds to term k
};

}  // namespace wheelwright
