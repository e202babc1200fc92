#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace wheelwright {

/// The rotation about the axle by one angle, for many vectors.
class AxleRotation {
 public:
  explicit AxleRotation(double angle) : cosine_(std::cos(angle)), sine_(std::sin(angle)) {}

  template <std::size_t dim>
  std::array<double, dim> forward(const std::array<double, dim>& v) const {
    return rotated(v, sine_);
  }
  template <std::size_t dim>
  std::array<double, dim> back(const std::array<double, dim>& v) const {
    return rotated(v, -sine_);
  }

 private:
  template <std::size_t dim>
  std::array<double, dim> rotated(std::array<double, dim> v, double sine) const {
    const double x = v[0], y = v[1];
    v[0] = cosine_ * x - sine * y;
    v[1] = sine * x + cosine_ * y;
    return v;
  }

  double cosine_, sine_;
};

}  // namespace wheelwright
