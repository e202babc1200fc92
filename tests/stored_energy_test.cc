#include "wheelwright/mechanics/hyperelastic/stored_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"

namespace wheelwright {
namespace {

constexpr double modulus = 8e6;

/// All forms with plane strain and plane stress, from almost incompressible to compressible.
template <int dim>
std::vector<StoredEnergy> energies() {
  std::vector<StoredEnergy> result;
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const double ratio : {0.3, 0.48, 0.4999})
      for (const EnergyForm form : {EnergyForm::neo_hookean, EnergyForm::saint_venant_kirchhoff,
                                    EnergyForm::mooney_rivlin, EnergyForm::small_strain})
        if (dim == 2 || plane == Plane::strain)
          result.push_back(StoredEnergy::of({modulus, ratio, plane}, form, 0.3));
  return result;
}

/// Deformations with strains up to 0.4.
template <int dim>
std::vector<Mat<dim>> deformations() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  std::vector<Mat<dim>> result;
  while (result.size() < 20) {
    Mat<dim> f;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) f[i][j] = (i == j) + uniform(random);
    result.push_back(f);
  }
  return result;
}

template <int dim>
void expect_derivatives() {
  constexpr double step = 1e-6;
  for (const StoredEnergy& energy : energies<dim>())
    for (const Mat<dim>& f : deformations<dim>()) {
      const auto r = response<dim>(energy, f);
      ASSERT_TRUE(r.admissible);
      const double stiffness = energy.mu + energy.lambda, tolerance = 1e-7 * stiffness;
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l) {
          Mat<dim> more = f, less = f;
          more[k][l] += step;
          less[k][l] -= step;
          const auto above = response<dim>(energy, more), below = response<dim>(energy, less);
          EXPECT_NEAR((above.energy - below.energy) / (2 * step), r.piola[k][l], tolerance);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j) {
              EXPECT_NEAR((above.piola[i][j] - below.piola[i][j]) / (2 * step),
                          r.tangent[dim * i + j][dim * k + l], tolerance);
              EXPECT_NEAR(r.tangent[dim * i + j][dim * k + l], r.tangent[dim * k + l][dim * i + j],
                          1e-12 * stiffness);
            }
          if constexpr (dim == 2) {
            const AxialSlopes slopes = axial_slopes(energy, f);
            EXPECT_NEAR((above.axial_stretch - below.axial_stretch) / (2 * step), slopes.stretch[k][l], 1e-7);
            EXPECT_NEAR((above.axial_piola - below.axial_piola) / (2 * step), slopes.piola[k][l], tolerance);
          }
        }
    }
}

TEST(StoredEnergy, StressAndTangentAreItsDerivatives) {
  expect_derivatives<2>();
  expect_derivatives<3>();
}

template <int dim>
void expect_pressure() {
  constexpr double step = 1e-6, pressure = 3e6;
  for (const EnergyForm form : {EnergyForm::neo_hookean, EnergyForm::mooney_rivlin})
    for (const Mat<dim>& f : deformations<dim>()) {
      const StoredEnergy energy = StoredEnergy::of({modulus, 0.48}, form, 0.3);
      const auto without = response<dim>(energy, f), with = response<dim>(energy, f, pressure);
      EXPECT_EQ(with.energy, without.energy);
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l) {
          Mat<dim> more = f, less = f;
          more[k][l] += step;
          less[k][l] -= step;
          EXPECT_NEAR(pressure * std::log(determinant<dim>(more) / determinant<dim>(less)) / (2 * step),
                      with.piola[k][l] - without.piola[k][l], 1e-7 * pressure);
          const auto above = response<dim>(energy, more, pressure),
                     below = response<dim>(energy, less, pressure);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              EXPECT_NEAR((above.piola[i][j] - below.piola[i][j]) / (2 * step),
                          with.tangent[dim * i + j][dim * k + l], 1e-7 * (energy.mu + energy.lambda));
        }
    }
}

TEST(StoredEnergy, APressureWorksOnTheLogarithmOfTheVolume) {
  expect_pressure<2>();
  expect_pressure<3>();
}

/// A rotation about an axis that is none of the frame's.
Mat<3> rotation() {
  const double a = 0.7, b = 1.9, c = std::cos(a), s = std::sin(a), d = std::cos(b), t = std::sin(b);
  return {{{c, -s * d, s * t}, {s, c * d, -c * t}, {0, t, d}}};
}

template <int dim>
Mat<dim> rotated_from_left(const Mat<dim>& f) {
  Mat<dim> result{};
  const double angle = 2.3;
  const Mat<2> in_plane{{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k) {
        if constexpr (dim == 2)
          result[i][j] += in_plane[i][k] * f[k][j];
        else
          result[i][j] += rotation()[i][k] * f[k][j];
      }
  return result;
}

template <int dim>
void expect_objectivity() {
  for (const StoredEnergy& energy : energies<dim>()) {
    if (energy.form == EnergyForm::small_strain) continue;
    for (const Mat<dim>& f : deformations<dim>()) {
      const auto r = response<dim>(energy, f), turned = response<dim>(energy, rotated_from_left<dim>(f));
      EXPECT_NEAR(turned.energy, r.energy, 1e-12 * (energy.lambda + energy.mu));
      const Mat<dim> piola = rotated_from_left<dim>(r.piola);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          EXPECT_NEAR(turned.piola[i][j], piola[i][j], 1e-11 * (energy.lambda + energy.mu));
    }
  }
}

TEST(StoredEnergy, DoesNotChangeWithARotation) {
  expect_objectivity<2>();
  expect_objectivity<3>();
}

/// Plane stress is a sheet of the three-dimensional material whose faces are free, plane strain one whose
/// thickness is held.
TEST(StoredEnergy, ThePlaneIsASheetOfTheSpatialMaterial) {
  for (const StoredEnergy& energy : energies<2>()) {
    StoredEnergy spatial = energy;
    spatial.plane = Plane::strain;
    for (const Mat<2>& f : deformations<2>()) {
      const auto r = response<2>(energy, f);
      const Mat<3> sheet{{{f[0][0], f[0][1], 0}, {f[1][0], f[1][1], 0}, {0, 0, r.axial_stretch}}};
      const auto of_sheet = response<3>(spatial, sheet);
      const double tolerance = 1e-12 * (energy.mu + energy.lambda);
      EXPECT_NEAR(r.energy, of_sheet.energy, tolerance);
      EXPECT_NEAR(r.axial_piola, of_sheet.piola[2][2], tolerance);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) EXPECT_NEAR(r.piola[i][j], of_sheet.piola[i][j], tolerance);
      EXPECT_EQ(energy.plane == Plane::strain ? r.axial_stretch - 1 : r.axial_piola, 0);
    }
  }
}

template <int dim>
void expect_hookes_law() {
  for (const StoredEnergy& energy : energies<dim>()) {
    const double nu = energy.lambda / (2 * (energy.lambda + energy.mu));
    const Material material{2 * energy.mu * (1 + nu), nu, energy.plane};
    Mat<dim> f{};
    for (int i = 0; i < dim; ++i) f[i][i] = 1;
    const auto r = response<dim>(energy, f);
    EXPECT_NEAR(r.energy, 0, 1e-15 * energy.lambda);
    Voigt<dim> strain;
    for (int k = 0; k < n_strains<dim>; ++k) strain[k] = 1 + 0.3 * k * k;
    const Voigt<dim> hooke = stress<dim>(material, strain);
    for (int k = 0; k < dim; ++k) EXPECT_NEAR(r.piola[0][k], 0, 1e-15 * energy.lambda);
    for (int i = 0; i < dim; ++i) {
      double sigma = 0;
      for (int k = 0; k < dim; ++k) sigma += r.tangent[dim * i + i][dim * k + k] * strain[k];
      EXPECT_NEAR(sigma, hooke[i], 1e-9 * std::abs(hooke[i]));
    }
    // The last shear, 12, by half from each of F_12 and F_21.
    EXPECT_NEAR(0.5 * (r.tangent[1][1] + r.tangent[1][dim]) * strain.back(), hooke.back(), 1e-9 * energy.mu);
  }
}

TEST(StoredEnergy, IsHookesLawForSmallStrains) {
  expect_hookes_law<2>();
  expect_hookes_law<3>();
}

TEST(StoredEnergy, TurnedInsideOutIsAValue) {
  for (const StoredEnergy& energy : energies<2>()) {
    if (energy.form == EnergyForm::small_strain) continue;
    for (const double area : {0.0, -0.2}) {
      const auto r = response<2>(energy, {{{1, 0}, {0.3, area}}});
      EXPECT_FALSE(r.admissible);
      EXPECT_EQ(r.energy, INFINITY);
      EXPECT_EQ(r.piola[1][1], 0);
    }
  }
}

/// A sheet of Saint Venant and Kirchhoff's form would thin to nothing.
TEST(StoredEnergy, StretchedToNothingIsAValue) {
  const StoredEnergy energy =
      StoredEnergy::of({modulus, 0.48, Plane::stress}, EnergyForm::saint_venant_kirchhoff);
  const auto r = response<2>(energy, {{{2, 0}, {0, 2}}});
  EXPECT_FALSE(r.admissible);
  EXPECT_EQ(r.energy, INFINITY);
}

/// Uniaxial tension of an incompressible neo-Hookean body: P = mu (s - 1/s^2).
TEST(StoredEnergy, TensionOfASheetIsThatOfTheTextbook) {
  const StoredEnergy energy = StoredEnergy::of({modulus, 0.4999999, Plane::stress});
  for (const double s : {0.6, 1.5, 2.5}) {
    const auto r = response<2>(energy, {{{s, 0}, {0, 1 / std::sqrt(s)}}});
    EXPECT_NEAR(r.piola[0][0], energy.mu * (s - 1 / (s * s)), 1e-5 * modulus);
    EXPECT_NEAR(r.piola[1][1], 0, 1e-5 * modulus);
  }
}

/// Strains E of the deformations above.
template <int dim>
Matrix strains() {
  Matrix result(static_cast<int>(deformations<dim>().size()), n_strains<dim>);
  int row = 0;
  for (const Mat<dim>& f : deformations<dim>()) {
    const auto component = [&](int i, int j) {
      double sum = i == j ? -1.0 : 0.0;
      for (int k = 0; k < dim; ++k) sum += f[k][i] * f[k][j];
      return i == j ? sum / 2 : sum;
    };
    if constexpr (dim == 2)
      for (int k = 0; k < 3; ++k) result(row, k) = component(k % 2, k == 0 ? 0 : 1);
    else
      for (int k = 0; k < 6; ++k)
        result(row, k) = component(k < 3 ? k : k == 3 ? 1 : 0, k < 3 ? k : k == 5 ? 1 : 2);
    ++row;
  }
  return result;
}

/// Compares derivatives of `values` along every strain with `slopes`.
template <int dim>
void expect_slopes(const Matrix& at, const std::function<std::vector<double>(const Matrix&)>& values,
                   const std::function<double(int, int)>& slope, double tolerance) {
  constexpr double step = 1e-6;
  for (int l = 0; l < n_strains<dim>; ++l) {
    Matrix more = at, less = at;
    for (int i = 0; i < at.rows(); ++i) {
      more(i, l) += step;
      less(i, l) -= step;
    }
    const auto above = values(more), below = values(less);
    for (int i = 0; i < at.rows(); ++i)
      EXPECT_NEAR((above[i] - below[i]) / (2 * step), slope(i, l), tolerance);
  }
}

template <int dim>
void expect_law() {
  const Matrix at = strains<dim>();
  const int n = n_strains<dim>;
  for (const StoredEnergy& energy : energies<dim>()) {
    if (energy.form == EnergyForm::small_strain || energy.lambda > 1000 * energy.mu) continue;
    const double nu = energy.lambda / (2 * (energy.lambda + energy.mu));
    const HyperelasticLaw<dim> law({2 * energy.mu * (1 + nu), nu, energy.plane}, energy.form, 0.3);
    Matrix stresses(at.rows(), n), slopes(at.rows(), n), tangents(at.rows(), n * n);
    law.stress(strain_columns<dim>(at, 0), stress_columns<dim>(stresses, 0));
    law.squared_von_mises_slope(strain_columns<dim>(at, 0), stress_columns<dim>(slopes, 0));
    TangentRows<dim> rows;
    for (int k = 0; k < n; ++k) rows[k] = stress_columns<dim>(tangents, n * k);
    law.tangent(strain_columns<dim>(at, 0), rows);
    const double tolerance = 2e-6 * (energy.mu + energy.lambda);
    expect_slopes<dim>(
        at,
        [&](const Matrix& strains) {
          std::vector<double> densities(strains.rows());
          law.energy_density(strain_columns<dim>(strains, 0), densities);
          return densities;
        },
        [&](int i, int l) { return stresses(i, l); }, tolerance);
    for (int k = 0; k < n; ++k)
      expect_slopes<dim>(
          at,
          [&](const Matrix& strains) {
            Matrix of_strains(at.rows(), n);
            law.stress(strain_columns<dim>(strains, 0), stress_columns<dim>(of_strains, 0));
            return std::vector<double>(of_strains.column(k), of_strains.column(k) + at.rows());
          },
          [&](int i, int l) { return tangents(i, n * k + l); }, 20 * tolerance);
    expect_slopes<dim>(
        at,
        [&](const Matrix& strains) {
          std::vector<double> squares(strains.rows());
          law.squared_von_mises(strain_columns<dim>(strains, 0), squares);
          return squares;
        },
        [&](int i, int l) { return slopes(i, l); }, 100 * tolerance * energy.mu);
  }
}

TEST(HyperelasticLaw, IsTheDerivativeOfItsEnergyByGreensStrain) {
  expect_law<2>();
  expect_law<3>();
}

TEST(HyperelasticLaw, IsHookesLawForSmallStrains) {
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const EnergyForm form :
         {EnergyForm::neo_hookean, EnergyForm::saint_venant_kirchhoff, EnergyForm::mooney_rivlin}) {
      const Material material{modulus, 0.4, plane};
      const HyperelasticLaw<2> law(material, form, 0.5);
      const IsotropicLaw<2> hooke(material);
      constexpr double small = 1e-7;
      const Voigt<2> strain{3 * small, -small, 2 * small};
      const auto sigma = stress<2>(law, strain), expected = stress<2>(hooke, strain);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sigma[k], expected[k], 1e-5 * modulus * small);
      double square = 0, expected_square = 0, axial, expected_axial, ignored;
      law.squared_von_mises(one_strain<2>(strain), {&square, 1});
      hooke.squared_von_mises(one_strain<2>(strain), {&expected_square, 1});
      EXPECT_NEAR(square / expected_square, 1, 1e-5);
      law.along_axle(one_strain<2>(strain), {&axial, 1}, {&ignored, 1});
      hooke.along_axle(one_strain<2>(strain), {&expected_axial, 1}, {&ignored, 1});
      EXPECT_NEAR(axial, expected_axial, 1e-5 * modulus * small);
    }
}

}  // namespace
}  // namespace wheelwright
