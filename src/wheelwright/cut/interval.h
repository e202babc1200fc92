#pragma once

#include <array>
#include <complex>
#include <span>

#include "wheelwright/geometry/gauss.h"

namespace wheelwright {

/// An interval of integration, substituted by u in [0, 1] so that a square root's branch point at an end
/// leaves a smooth integrand.
struct Interval {
  double from, to;
  bool root_at_from, root_at_to;  ///< a branch point lies there
  double first = 0, last = 1;     ///< the part of the substituted interval that is meant

  struct Place {
    double x, dx;           ///< dx/du
    double fraction, rest;  ///< of the interval, before and behind x
  };
  Place at(double u) const;
  double width() const { return at(1).x - at(0).x; }
  std::array<Interval, 2> halves() const;

  /// The substituted coordinate of a place: 0 at `from`, 1 at `to`.
  std::complex<double> substituted(std::complex<double> place) const;

  /// Whether the branch points of the integrand, other than those at the ends, are so far that a Gauss rule
  /// converges fast.
  bool is_far_from_branch_points(std::span<const std::complex<double>> places) const;
  /// Whether a pole is so far that samples show it, or within the interval, where only a zero outside of the
  /// square has one.
  bool is_far_from_pole(std::complex<double> place) const;

 private:
  double ellipse_through(std::complex<double> place) const;
};

/// Tells from samples of a function whether a Gauss rule integrates it well: whether its Legendre series on
/// the interval decays.
class Resolution {
 public:
  static constexpr int n_samples = 7;
  using Samples = std::array<double, n_samples>;

  Resolution();

  /// Where to sample, in [0, 1].
  const std::vector<double>& places() const { return rule_.points; }

  /// Whether the last terms are small beside those that vary, or below `negligible`.
  bool varies_smoothly(const Samples& f, double negligible) const;
  /// Whether the last terms are small beside the mean.
  bool is_smooth(const Samples& f) const;

 private:
  Samples series(const Samples& f) const;

  GaussRule rule_;
  std::array<Samples, n_samples> legendre_;  ///< [k][q]: what sample q adds to term k
};

}  // namespace wheelwright
