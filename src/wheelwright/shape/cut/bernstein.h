#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "wheelwright/shape/geometry/lagrange.h"

namespace wheelwright {

// Polynomials on [0, 1] in Bernstein form. The coefficients bound the polynomial, and a reflection of the
// argument reverses them, so that results are reflected up to rounding.

/// c0 (1-x)^2 + 2 c1 x (1-x) + c2 x^2
using Quadratic = std::array<double, 3>;
using Quartic = std::array<double, 5>;

inline double value(const Quadratic& c, double x) {
  return (c[0] * (1 - x) * (1 - x) + c[2] * x * x) + 2 * c[1] * x * (1 - x);
}

inline double derivative(const Quadratic& c, double x) {
  return 2 * ((c[1] - c[0]) * (1 - x) + (c[2] - c[1]) * x);
}

/// The square of half the derivative at the roots, to the last digits (Kahan's algorithm); negative where
/// they are complex.
inline double discriminant(const Quadratic& c) {
  const double ends = c[0] * c[2];
  return std::fma(c[1], c[1], -ends) + std::fma(-c[0], c[2], ends);
}

/// A root u / (u + v), kept as two numbers because both that ratio and its complement may be tiny.
struct Root {
  double u, v;
  bool inside() const { return (u > 0 && v > 0) || (u < 0 && v < 0); }  ///< of (0, 1)
  double x() const { return u / (u + v); }
};

/// The root at which the quadratic rises, or falls, through zero; `half_slope`: square root of its
/// discriminant.
Root root(const Quadratic& c, double half_slope, bool rising);

/// The discriminant, as a polynomial in a parameter, of the quadratics whose coefficients are the quadratics
/// c[i] of that parameter.
Quartic discriminant_of(const std::array<Quadratic, 3>& c);

/// The places in (0, 1) where the polynomial changes its sign, ascending.
std::vector<double> sign_changes(const Quadratic& c);

/// Zeros of y^2 - r y - s: real, or each other's conjugates.
std::array<std::complex<double>, 2> zeros_of(double r, double s);

/// A polynomial as a product: leading * (x - zeros[0]) * (x - zeros[1]) ... Real zeros have no imaginary
/// part; others come with their conjugates. The product agrees with the polynomial to rounding even if zeros
/// are double and thus accurate only to the square root of rounding.
struct Factors {
  double leading;
  std::vector<std::complex<double>> zeros;  ///< without those close to infinity
};
Factors factors_of(const Quartic& c);

/// A tensor product of quadratics on the unit cell; axis 0 is the fastest in `coefficients`.
template <int dim>
class BernsteinForm {
 public:
  /// `degree`: 1 or 2, that of the nodal values.
  BernsteinForm(int degree, std::span<const double> nodal_values);

  double operator[](const std::array<int, dim>& index) const;

  double largest() const;   ///< of the coefficients
  double smallest() const;  ///< of the coefficients

  /// Bounds of the derivative along an axis, divided by the degree 2: its smallest and its largest
  /// coefficient.
  std::array<double, 2> derivative_bounds(int axis) const;
  /// Sum of the coefficients' differences along an axis: a measure of the polynomial's change along it.
  double variation(int axis) const;

 private:
  /// Calls visit(first, stride) for every line of three coefficients along an axis.
  template <class Visit>
  static void for_each_line(int axis, Visit visit);

  std::array<double, power(3, dim)> coefficients_;
};

}  // namespace wheelwright
