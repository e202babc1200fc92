#include "wheelwright/mechanics/elasticity/orthotropic_material.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

using Normal3 = std::array<std::array<double, 3>, 3>;

/// The stiffness of normal stresses to normal strains: the inverse of the compliance, by cofactors.
Normal3 normal_stiffness(const OrthotropicMaterial& m) {
  const auto [a, b, c] = m.couplings();
  const double determinant = m.determinant();
  const Normal3 cofactors{{{1 - c * c, a + b * c, b + a * c},
                           {a + b * c, 1 - b * b, c + a * b},
                           {b + a * c, c + a * b, 1 - a * a}}};
  const std::array roots{std::sqrt(m.modulus_r), std::sqrt(m.modulus_t), std::sqrt(m.modulus_z)};
  Normal3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i][j] = roots[i] * roots[j] * cofactors[i][j] / determinant;
  return result;
}

}  // namespace

auto OrthotropicMaterial::couplings() const -> Couplings {
  return {ratio_rt * std::sqrt(modulus_t / modulus_r), ratio_rz * std::sqrt(modulus_z / modulus_r),
          ratio_tz * std::sqrt(modulus_z / modulus_t)};
}

double OrthotropicMaterial::determinant() const {
  const auto [a, b, c] = couplings();
  return 1 - a * a - b * b - c * c - 2 * a * b * c;
}

bool OrthotropicMaterial::is_stable() const {
  const auto [a, b, c] = couplings();
  return std::max({std::abs(a), std::abs(b), std::abs(c)}) < 1 && determinant() > 0;
}

/// With 1 - x for the eigenvalue, x^3 - (a^2 + b^2 + c^2) x - 2 a b c = 0, whose roots are real.
double OrthotropicMaterial::least_compliance() const {
  const auto [a, b, c] = couplings();
  if (plane == Plane::stress) return 1 - std::abs(a);
  const double third = (a * a + b * b + c * c) / 3, radius = std::sqrt(third);
  if (radius == 0) return 1;
  const double angle = std::acos(std::clamp(a * b * c / (third * radius), -1.0, 1.0)) / 3;
  return 1 - 2 * radius * std::cos(angle);
}

PlaneCompliance OrthotropicMaterial::plane_compliance() const {
  const double rr = 1 / modulus_r, tt = 1 / modulus_t, rt = -ratio_rt / modulus_r;
  if (plane == Plane::stress) return {rr, tt, rt, 1 / shear_rt};
  const double rz = -ratio_rz / modulus_r, tz = -ratio_tz / modulus_t;
  return {rr - rz * rz * modulus_z, tt - tz * tz * modulus_z, rt - rz * tz * modulus_z, 1 / shear_rt};
}

template <>
std::array<Voigt<2>, 3> OrthotropicMaterial::stiffness<2>() const {
  if (plane == Plane::strain) {
    const Normal3 normal = normal_stiffness(*this);
    return {{{normal[0][0], normal[0][1], 0}, {normal[1][0], normal[1][1], 0}, {0, 0, shear_rt}}};
  }
  const double a = couplings().rt, factor = 1 / (1 - a * a);
  const double coupled = factor * a * std::sqrt(modulus_r * modulus_t);
  return {{{factor * modulus_r, coupled, 0}, {coupled, factor * modulus_t, 0}, {0, 0, shear_rt}}};
}

template <>
std::array<Voigt<3>, 6> OrthotropicMaterial::stiffness<3>() const {
  const Normal3 normal = normal_stiffness(*this);
  std::array<Voigt<3>, 6> result{};
  for (int i = 0; i < 3; ++i) std::copy(normal[i].begin(), normal[i].end(), result[i].begin());
  result[3][3] = shear_tz;
  result[4][4] = shear_rz;
  result[5][5] = shear_rt;
  return result;
}

double OrthotropicMaterial::radial_stiffness() const { return stiffness<2>()[0][0]; }

double OrthotropicMaterial::contact_modulus() const {
  const auto [rr, tt, rt, shear] = plane_compliance();
  return 2 / std::sqrt(rr * (2 * std::sqrt(rr * tt) + 2 * rt + shear));
}

double OrthotropicMaterial::scaling_modulus() const {
  const double mean = std::sqrt(modulus_r * modulus_t), nu = std::abs(couplings().rt);
  return plane == Plane::strain ? mean : mean * (1 + 2 * nu) / ((1 + nu) * (1 + nu));
}

}  // namespace wheelwright
