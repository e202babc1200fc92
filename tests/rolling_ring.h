#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/mechanics/elasticity/material.h"

namespace wheelwright::testing {

/// A ring without holes on rigid ground without friction. Per metre of width.
struct RollingRing {
  double load, travel, strain_energy, peak_pressure;
  double half_width;  ///< of the patch, along the ground
};

/// The exact solution of a ring that is bonded to a rigid rim, for the load under which it touches the ground
/// from azimuth -half_angle to half_angle, flat or a drum, whose normals push: a Fourier series of Kolosov's
/// potentials for the displacements, and for the pressure sqrt(1 - s^2) times Chebyshev polynomials of s =
/// azimuth / half_angle. It shares nothing with the elements and the contact of the program.
class RollingRingSeries {
 public:
  /// `curvature`: 1/radius of the drum on which the ring rolls; negative inside a drum.
  RollingRingSeries(double inner, double outer, const Material& material, double curvature = 0)
      : inner_(inner),
        outer_(outer),
        curvature_(curvature),
        mu_(material.youngs_modulus / (2 * (1 + material.poissons_ratio))),
        kappa_(material.plane == Plane::strain
                   ? 3 - 4 * material.poissons_ratio
                   : (3 - material.poissons_ratio) / (1 + material.poissons_ratio)) {}

  RollingRing at(double half_angle) const {
    constexpr int n_terms = 6, n_points = n_terms + 1;
    std::vector<double> azimuths;
    for (int i = 0; i < n_points; ++i)
      azimuths.push_back(half_angle * std::cos((2 * i + 1) * std::numbers::pi / (4 * n_points)));
    const Matrix displacements = towards_ground(n_terms, half_angle, azimuths);
    // They touch: displacement + travel = the height of the undeformed tread above its lowest point.
    Matrix system(n_points, n_points), heights(n_points, 1);
    for (int i = 0; i < n_points; ++i) {
      for (int j = 0; j < n_terms; ++j) system(i, j) = displacements(i, j);
      system(i, n_terms) = std::cos(tilt(azimuths[i]));
      heights(i, 0) = gap(azimuths[i]);
    }
    const Matrix factors = LuFactor::factor(std::move(system))->solve(std::move(heights));
    const std::vector<double> unknowns(factors.column(0), factors.column(0) + n_points);
    RollingRing ring{0, unknowns[n_terms], 0, 0, outer_ * std::sin(half_angle)};
    ring.load = load(unknowns, half_angle);
    for (int j = 0; j < n_terms; ++j) ring.peak_pressure += unknowns[j] * (j % 2 == 0 ? 1 : -1);
    ring.strain_energy = strain_energy(unknowns, half_angle, ring.travel);
    return ring;
  }

 private:
  static constexpr int n_harmonics = 100000, n_harmonics_on_drum = 4000;

  /// The angle from n_y to the normal of the ground at a point of the undeformed tread, towards larger
  /// azimuth.
  double tilt(double azimuth) const {
    const double sine = std::sin(azimuth), height = outer_ * (1 - std::cos(azimuth));
    return std::atan2(-curvature_ * outer_ * sine, 1 + curvature_ * height);
  }
  /// The distance of that point from the ground: height on flat ground.
  double gap(double azimuth) const {
    const double along = outer_ * std::sin(azimuth), height = outer_ * (1 - std::cos(azimuth));
    const double to_centre = std::hypot(curvature_ * along, 1 + curvature_ * height);  // times |curvature|
    return (curvature_ * (along * along + height * height) + 2 * height) / (to_centre + 1);
  }

  struct Polar {
    double radial, tangential;  ///< factors of cos(m azimuth) and of sin(m azimuth)
  };

  /// The displacement, times 2 mu, and the traction on a circle of one solution of the equations of
  /// elasticity.
  struct Solution {
    Polar displacement, traction;
  };

  /// phi = z^k, times scale / r^k; m = k - 1 or 1 - k.
  Solution of_phi(int k, double scale, double r) const {
    const double sign = k > 0 ? 1 : -1;  // of k - 1; for k = 1 the sines vanish
    return {{scale * (kappa_ - k), sign * scale * (kappa_ + k)},
            {scale / r * k * (3 - k), sign * scale / r * k * (k - 1)}};
  }
  /// psi = z^k, times scale / r^k; m = k + 1 or -k - 1.
  Solution of_psi(int k, double scale, double r) const {
    const double sign = k > 0 ? 1 : -1;
    return {{-scale, sign * scale}, {-scale / r * k, sign * scale / r * k}};
  }
  /// The force at the centre: phi = log z, psi = -kappa log z.
  Solution of_force(double r) const {
    const double radial = 2 * kappa_ * std::log(r / outer_);
    return {{radial - 1, -radial - 1}, {(3 + kappa_) / r, (1 - kappa_) / r}};
  }
  static Solution of_translation() { return {{1, -1}, {0, 0}}; }

  /// The four solutions of a harmonic m > 0, of the size 1 where they are largest.
  std::array<Solution, 4> solutions(int m, double r) const {
    const double outwards = std::pow(r / outer_, m), inwards = std::pow(inner_ / r, m);
    return {of_phi(1 + m, r / outer_ * outwards, r), of_psi(-m - 1, inner_ / r * inwards, r),
            m == 1 ? of_force(r) : of_phi(1 - m, r / inner_ * inwards, r),
            m == 1 ? of_translation() : of_psi(m - 1, outer_ / r * outwards, r)};
  }

  /// The displacements of the tread under tractions 1, radial and tangential.
  std::array<Polar, 2> displacements(int m) const {
    if (m == 0) {  // Lame: phi = A z, psi = B / z
      const double b = inner_ * inner_ * (kappa_ - 1), a = 1 / (2 + b / (outer_ * outer_));
      return {Polar{a * ((kappa_ - 1) * outer_ - b / outer_) / (2 * mu_), 0}, Polar{0, 0}};
    }
    const auto at_rim = solutions(m, inner_), at_tread = solutions(m, outer_);
    Matrix system(4, 4), tractions(4, 2);
    for (int k = 0; k < 4; ++k) {
      system(0, k) = at_rim[k].displacement.radial;
      system(1, k) = at_rim[k].displacement.tangential;
      system(2, k) = at_tread[k].traction.radial;
      system(3, k) = at_tread[k].traction.tangential;
    }
    tractions(2, 0) = tractions(3, 1) = 1;
    const Matrix factors = LuFactor::factor(std::move(system))->solve(std::move(tractions));
    std::array<Polar, 2> u{};
    for (int l = 0; l < 2; ++l)
      for (int k = 0; k < 4; ++k) {
        u[l].radial += factors(k, l) * at_tread[k].displacement.radial / (2 * mu_);
        u[l].tangential += factors(k, l) * at_tread[k].displacement.tangential / (2 * mu_);
      }
    return u;
  }

  /// The factor of cos(n azimuth) in the pressure sqrt(1 - s^2) U_2j(s), halved for n = 0.
  static double pressure_factor(int j, double half_angle, int n) {
    const double w = n * half_angle;
    const double integral =
        n == 0 ? (j == 0 ? 0.5 : 0) : (j % 2 == 0 ? 1 : -1) * (2 * j + 1) * ::jn(2 * j + 1, w) / w;
    return half_angle * integral / (n == 0 ? 2 : 1);
  }

  /// The factors of cos(m azimuth) in the radial and of sin(m azimuth) in the tangential traction of a term
  /// of the pressure, which acts normal to the ground.
  Polar tractions(int j, double half_angle, int m) const {
    if (curvature_ == 0) {
      const double before = m == 0 ? 0 : (m == 1 ? 2 : 1) * pressure_factor(j, half_angle, m - 1),
                   after = pressure_factor(j, half_angle, m + 1);
      return {-(before + after) / 2, (before - after) / 2};
    }
    constexpr int n = 1000;  // azimuth = half_angle cos(t): a trapezoidal sum, for m half_angle < 2 n
    Polar sum{0, 0};
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) * std::numbers::pi / n, azimuth = half_angle * std::cos(t);
      const double pressure = half_angle * std::sin(t) * std::sin((2 * j + 1) * t) / n;
      const double to_normal = azimuth - tilt(azimuth);
      sum.radial -= pressure * std::cos(to_normal) * std::cos(m * azimuth) / (m == 0 ? 2 : 1);
      sum.tangential += pressure * std::sin(to_normal) * std::sin(m * azimuth);
    }
    return sum;
  }

  /// The resultant of the pressure towards the axle.
  double load(const std::vector<double>& factors, double half_angle) const {
    if (curvature_ == 0) return factors[0] * outer_ * half_angle * std::numbers::pi / 2;
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) * std::numbers::pi / n;
      for (std::size_t j = 0; j + 1 < factors.size(); ++j)
        sum +=
            factors[j] * std::sin(t) * std::sin((2 * j + 1) * t) * std::cos(tilt(half_angle * std::cos(t)));
    }
    return sum * outer_ * half_angle * std::numbers::pi / n;
  }

  /// The displacements towards the ground, along its normal, at the azimuths under each term of the pressure.
  Matrix towards_ground(int n_terms, double half_angle, const std::vector<double>& azimuths) const {
    Matrix result(static_cast<int>(azimuths.size()), n_terms);
    for (int m = 0; m < (curvature_ == 0 ? n_harmonics : n_harmonics_on_drum); ++m) {
      const auto [under_radial, under_tangential] = displacements(m);
      for (int j = 0; j < n_terms; ++j) {
        const auto [radial, tangential] = tractions(j, half_angle, m);
        const double u = radial * under_radial.radial + tangential * under_tangential.radial,
                     v = radial * under_radial.tangential + tangential * under_tangential.tangential;
        for (int i = 0; i < result.rows(); ++i)
          result(i, j) += u * std::cos(m * azimuths[i]) * std::cos(azimuths[i] - tilt(azimuths[i])) -
                          v * std::sin(m * azimuths[i]) * std::sin(azimuths[i] - tilt(azimuths[i]));
      }
    }
    return result;
  }

  /// Half of the work of the pressure, whose points move by gap - travel.
  double strain_energy(const std::vector<double>& factors, double half_angle, double travel) const {
    constexpr int n = 400;
    double work = 0;
    for (int i = 0; i < n; ++i) {  // s = cos(t): a trapezoidal sum, which is exact for cosines
      const double t = (i + 0.5) * std::numbers::pi / n, azimuth = half_angle * std::cos(t);
      double pressure_sine = 0;  // pressure times the sine of t
      for (std::size_t j = 0; j + 1 < factors.size(); ++j)
        pressure_sine += factors[j] * std::sin(t) * std::sin((2 * j + 1) * t);
      work += pressure_sine * (travel * std::cos(tilt(azimuth)) - gap(azimuth));
    }
    return work / 2 * outer_ * half_angle * std::numbers::pi / n;
  }

  double inner_, outer_, curvature_, mu_, kappa_;
};

}  // namespace wheelwright::testing
