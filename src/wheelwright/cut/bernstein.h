#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "wheelwright/geometry/lagrange.h"

namespace wheelwright {

// Polynomials on [0, 1] in Bernstein form. Their coefficients bound them, and a reflection of the argument
// reverses the coefficients, so that what is computed of them is reflected up to rounding.

/// c0 (1-x)^2 + 2 c1 x (1-x) + c2 x^2
using Quadratic = std::array<double, 3>;
using Quartic = std::array<double, 5>;

inline double value(const Quadratic& c, double x) {
  return (c[0] * (1 - x) * (1 - x) + c[2] * x * x) + 2 * c[1] * x * (1 - x);
}

inline double derivative(const Quadratic& c, double x) {
  return 2 * ((c[1] - c[0]) * (1 - x) + (c[2] - c[1]) * x);
}

/// The square of half the derivative at the roots; negative where they are complex.
inline double discriminant(const Quadratic& c) { return c[1] * c[1] - c[0] * c[2]; }

/// A root u / (u + v), kept as two numbers because both that ratio and its complement may be tiny.
struct Root {
  double u, v;
  bool inside() const { return (u > 0 && v > 0) || (u < 0 && v < 0); }  ///< of (0, 1)
  double x() const { return u / (u + v); }
};

/// Where the quadratic rises, or falls, through zero; `half_slope`: square root of its discriminant.
Root root(const Quadratic& c, double half_slope, bool rising);

/// The discriminant of a family of quadratics whose coefficients are the quadratics c[i] of a parameter
/// themselves, in that parameter.
Quartic discriminant_of(const std::array<Quadratic, 3>& c);

/// The places in (0, 1) where the polynomial changes its sign, ascending, and a place between two such that
/// are closer than 1e-8 to each other. A polynomial below `noise` has none.
std::vector<double> sign_changes(const Quartic& c, double noise);
std::vector<double> sign_changes(const Quadratic& c);

/// The polynomial on the part [from, to] of its interval.
Quartic part_of(const Quartic& c, double from, double to);

/// The value at x; `rest` is 1 - x, to the last digit where x is next to 1.
double value(Quartic c, double x, double rest);

/// All zeros of the polynomial but those that are next to infinity, to about the square root of the rounding
/// error where they are double.
std::vector<std::complex<double>> complex_zeros(const Quartic& c);

/// A tensor product of quadratics on the unit cell; axis 0 is the fastest in `coefficients`.
template <int dim>
class BernsteinForm {
 public:
  /// `degree`: 1 or 2, that of the nodal values.
  BernsteinForm(int degree, std::span<const double> nodal_values);

  /// On one of the 3^dim equal boxes that the cell is divided into; `third`: its place, 0 to 2 on each axis.
  BernsteinForm part(const std::array<int, dim>& third) const;

  double operator[](const std::array<int, dim>& index) const;

  double largest() const;   ///< of the coefficients
  double smallest() const;  ///< of the coefficients
  double magnitude() const;

  /// Bounds of the derivative along an axis, divided by the degree 2: its smallest and its largest
  /// coefficient.
  std::array<double, 2> derivative_bounds(int axis) const;
  /// Sum of the coefficients' differences along an axis: how much the polynomial changes along it.
  double variation(int axis) const;

 private:
  /// Calls visit(first, stride) for every line of three coefficients along an axis.
  template <class Visit>
  static void for_each_line(int axis, Visit visit);

  std::array<double, power(3, dim)> coefficients_;
};

}  // namespace wheelwright
