#include "wheelwright/mechanics/elasticity/symmetric_tensor.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

// Needs <complex> before it.
#include <lapacke.h>

namespace wheelwright {

namespace {

/// Whether the third axis is a principal one, as in the plane of a wheel.
bool is_plane(const SymmetricTensor& tensor) { return tensor[3] == 0 && tensor[4] == 0; }

struct InPlane {
  double high, low;  ///< eigenvalues in the plane of the first two axes
};
InPlane in_plane(const SymmetricTensor& t) {
  const double mean = 0.5 * (t[0] + t[1]), radius = std::hypot(0.5 * (t[0] - t[1]), t[5]);
  return {mean + radius, mean - radius};
}

}  // namespace

/// By the cosine of a third of an angle.
std::array<double, 3> principal_values(const SymmetricTensor& tensor) {
  if (is_plane(tensor)) {
    const auto [high, low] = in_plane(tensor);
    if (tensor[2] >= high) return {tensor[2], high, low};
    if (tensor[2] <= low) return {high, low, tensor[2]};
    return {high, tensor[2], low};
  }
  const double mean = (tensor[0] + tensor[1] + tensor[2]) / 3;
  const double a = tensor[0] - mean, b = tensor[1] - mean, c = tensor[2] - mean;
  const auto [d, e, f] = std::array{tensor[3], tensor[4], tensor[5]};
  const double radius = std::sqrt((a * a + b * b + c * c + 2 * (d * d + e * e + f * f)) / 6);
  if (radius == 0) return {mean, mean, mean};
  const double determinant = a * b * c + 2 * d * e * f - a * d * d - b * e * e - c * f * f;
  const double angle = std::acos(std::clamp(determinant / (2 * radius * radius * radius), -1.0, 1.0)) / 3;
  constexpr double third = 2 * std::numbers::pi / 3;
  return {mean + 2 * radius * std::cos(angle), mean + 2 * radius * std::cos(angle - third),
          mean + 2 * radius * std::cos(angle + third)};
}

std::array<std::array<double, 3>, 3> principal_axes(const SymmetricTensor& tensor) {
  if (is_plane(tensor)) {
    using Axis = std::array<double, 3>;
    const double angle = 0.5 * std::atan2(2 * tensor[5], tensor[0] - tensor[1]);
    const Axis high{std::cos(angle), std::sin(angle), 0}, low{-high[1], high[0], 0}, axial{0, 0, 1};
    const auto values = in_plane(tensor);
    if (tensor[2] >= values.high) return {axial, high, low};
    if (tensor[2] <= values.low) return {high, low, axial};
    return {high, axial, low};
  }
  const auto [a, b, c, d, e, f] = tensor;
  double matrix[9] = {a, f, e, f, b, d, e, d, c}, values[3];
  LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', 3, matrix, 3, values);  // ascending
  std::array<std::array<double, 3>, 3> axes;
  for (int k = 0; k < 3; ++k) std::copy_n(matrix + 3 * (2 - k), 3, axes[k].begin());
  return axes;
}

SymmetricTensor slope_along(const std::array<double, 3>& n) {
  return {n[0] * n[0], n[1] * n[1], n[2] * n[2], 2 * n[1] * n[2], 2 * n[0] * n[2], 2 * n[0] * n[1]};
}

}  // namespace wheelwright
