#pragma once

#include <optional>

namespace wheelwright {

/// A differentiable approximation of the peak of f >= 0: J = c (int f^p)^(1/p), with lengths in metres.
/// Without a given c it is peak / (int f^p)^(1/p) at each shape and position, so that J is the true peak at
/// the quadrature points and its derivative that of the p-norm, with c held.
struct PeakNorm {
  int exponent = 16;  ///< p, even
  std::optional<double> correction = {};

  /// c and (int f^p)^(1/p).
  struct Value {
    double correction, norm;
    double peak() const { return correction * norm; }
  };

  /// From the peak of f and the integral of (f / unit)^p.
  Value value(double peak, double integral, double unit) const;
};

}  // namespace wheelwright
