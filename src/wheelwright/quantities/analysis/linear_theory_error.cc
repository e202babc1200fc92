#include "wheelwright/quantities/analysis/linear_theory_error.h"

#include <cmath>

namespace wheelwright {
namespace {

/// The symmetric tensor of a strain with engineering shears.
template <int dim>
Mat<dim> tensor(const Voigt<dim>& strain) {
  if constexpr (dim == 2) {
    const auto& [xx, yy, xy] = strain;
    return {{{xx, xy / 2}, {xy / 2, yy}}};
  } else {
    const auto& [xx, yy, zz, yz, xz, xy] = strain;
    return {{{xx, xy / 2, xz / 2}, {xy / 2, yy, yz / 2}, {xz / 2, yz / 2, zz}}};
  }
}

/// The displacement gradient of a strain and a rotation.
template <int dim>
Mat<dim> gradient(Mat<dim> strain, const Vec<dim*(dim - 1) / 2>& rotation) {
  const auto turn = [&](int from, int to, double angle) {
    strain[to][from] += angle;
    strain[from][to] -= angle;
  };
  if constexpr (dim == 2) {
    turn(0, 1, rotation[0]);
  } else {
    for (int axis = 0; axis < 3; ++axis) turn((axis + 1) % 3, (axis + 2) % 3, rotation[axis]);
  }
  return strain;
}

/// m^T m with engineering shears, as a strain.
template <int dim>
Voigt<dim> square(const Mat<dim>& m) {
  const auto product = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < dim; ++k) sum += m[k][i] * m[k][j];
    return sum;
  };
  if constexpr (dim == 2)
    return {product(0, 0), product(1, 1), 2 * product(0, 1)};
  else
    return {product(0, 0),     product(1, 1),     product(2, 2),
            2 * product(1, 2), 2 * product(0, 2), 2 * product(0, 1)};
}

}  // namespace

ExpandedEnergy& ExpandedEnergy::operator+=(const ExpandedEnergy& other) {
  linear += other.linear;
  of_rotation += other.of_rotation;
  of_strain += other.of_strain;
  of_bending += other.of_bending;
  return *this;
}

ExpandedEnergy operator*(double volume, ExpandedEnergy density) {
  return {volume * density.linear, volume * density.of_rotation, volume * density.of_strain,
          volume * density.of_bending};
}

template <int dim>
ExpandedEnergy expanded_energy(const Voigt<dim>& stress, const Voigt<dim>& strain,
                               const Vec<dim*(dim - 1) / 2>& rotation) {
  const Mat<dim> e = tensor<dim>(strain);
  const double linear = 0.5 * dot(stress, strain), of_strain = 0.5 * dot(stress, square<dim>(e)),
               third_order = 0.5 * dot(stress, square<dim>(gradient<dim>(e, rotation)));
  return {linear, third_order - of_strain, of_strain, linear * dot(rotation, rotation)};
}

double LinearTheoryError::size() const {
  return std::abs(of_rotation) + std::abs(of_strain) + std::abs(of_bending);
}

LinearTheoryError linear_theory_error(const ExpandedEnergy& energy) {
  return {1.5 * energy.of_rotation / energy.linear, 1.5 * energy.of_strain / energy.linear,
          2 * energy.of_bending / energy.linear};
}

double share_within(const LinearTheoryError& error, double limit) {
  if (error.size() <= limit) return 1;
  const double first = std::abs(error.of_rotation) + std::abs(error.of_strain), second = error.of_bending;
  return 2 * limit / (first + std::sqrt(first * first + 4 * second * limit));
}

template decltype(expanded_energy<2>) expanded_energy<2>;
template decltype(expanded_energy<3>) expanded_energy<3>;

}  // namespace wheelwright
