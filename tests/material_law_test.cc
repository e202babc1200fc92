// Material laws: the built-in one against finite differences, and laws of a program's own in a wheel.

#include <gtest/gtest.h>

#include <random>

#include "examples/own_material/warm_polymer.h"
#include "tests/support.h"
#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"

namespace wheelwright {
namespace {

constexpr double modulus = 60e6, ratio = 0.4;

/// A block of random strains, one column per component.
template <int dim>
Matrix random_strains(int n_points) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> strain(-0.02, 0.02);
  Matrix strains(n_points, n_strains<dim>);
  for (double& x : strains.entries()) x = strain(random);
  return strains;
}

template <int dim>
Matrix stresses_at(const MaterialLaw<dim>& law, const Matrix& strains) {
  Matrix result(strains.rows(), strains.columns());
  law.stress(strain_columns<dim>(strains, 0), stress_columns<dim>(result, 0));
  return result;
}

/// The derivative of a function of a block of strains, one value per point, by central differences.
template <class Values>
Matrix slopes_of(const Values& values, const Matrix& strains) {
  constexpr double h = 1e-6;
  Matrix slopes(strains.rows(), strains.columns());
  for (int k = 0; k < strains.columns(); ++k) {
    Matrix more = strains, less = strains;
    for (int i = 0; i < strains.rows(); ++i) {
      more(i, k) += h;
      less(i, k) -= h;
    }
    const std::vector<double> above = values(more), below = values(less);
    for (int i = 0; i < strains.rows(); ++i) slopes(i, k) = (above[i] - below[i]) / (2 * h);
  }
  return slopes;
}

/// Stress, tangent and slope of the von Mises stress of a law are derivatives, for every point of a block.
template <int dim>
void expect_derivatives(const MaterialLaw<dim>& law) {
  constexpr int n_points = 5, n = n_strains<dim>;
  const Matrix strains = random_strains<dim>(n_points), sigma = stresses_at(law, strains);
  const double tolerance = 1e-6 * law.scaling_modulus();

  const Matrix of_energy = slopes_of(
      [&](const Matrix& at) {
        std::vector<double> energies(n_points);
        law.energy_density(strain_columns<dim>(at, 0), energies);
        return energies;
      },
      strains);
  for (size_t i = 0; i < sigma.entries().size(); ++i)
    EXPECT_NEAR(of_energy.entries()[i], sigma.entries()[i], tolerance);

  Matrix tangents(n_points, n * n);
  TangentRows<dim> rows;
  for (int k = 0; k < n; ++k) rows[k] = stress_columns<dim>(tangents, n * k);
  law.tangent(strain_columns<dim>(strains, 0), rows);
  for (int k = 0; k < n; ++k) {
    const Matrix of_stress = slopes_of(
        [&](const Matrix& at) {
          const Matrix stresses = stresses_at(law, at);
          return std::vector<double>(stresses.column(k), stresses.column(k) + n_points);
        },
        strains);
    for (int i = 0; i < n_points; ++i)
      for (int l = 0; l < n; ++l) EXPECT_NEAR(of_stress(i, l), tangents(i, n * k + l), tolerance);
  }

  Matrix slopes(n_points, n);
  law.squared_von_mises_slope(strain_columns<dim>(strains, 0), stress_columns<dim>(slopes, 0));
  const Matrix of_squares = slopes_of(
      [&](const Matrix& at) {
        std::vector<double> squares(n_points);
        law.squared_von_mises(strain_columns<dim>(at, 0), squares);
        return squares;
      },
      strains);
  for (size_t i = 0; i < slopes.entries().size(); ++i)
    EXPECT_NEAR(of_squares.entries()[i], slopes.entries()[i], tolerance * law.scaling_modulus());
}

TEST(MaterialLaw, IsotropicLawsAreDerivativesOfTheirEnergy) {
  expect_derivatives<2>(IsotropicLaw<2>({modulus, ratio}));
  expect_derivatives<2>(IsotropicLaw<2>({modulus, ratio, Plane::stress}));
  expect_derivatives<3>(IsotropicLaw<3>({modulus, ratio}));
}

TEST(MaterialLaw, OrthotropicLawsAreDerivativesOfTheirEnergy) {
  OrthotropicMaterial material{.modulus_r = 40e6,
                               .modulus_t = 90e6,
                               .modulus_z = 60e6,
                               .ratio_rt = 0.1,
                               .ratio_rz = 0.31,
                               .ratio_tz = 0.42,
                               .shear_rt = 45e6,
                               .shear_rz = 33e6,
                               .shear_tz = 70e6};
  expect_derivatives<2>(OrthotropicLaw<2>(material));
  expect_derivatives<3>(OrthotropicLaw<3>(material));
  material.plane = Plane::stress;
  expect_derivatives<2>(OrthotropicLaw<2>(material));
}

TEST(MaterialLaw, AnOwnLawIsTheDerivativeOfItsEnergy) {
  expect_derivatives<2>(WarmPolymer(modulus, ratio, 60));
}

/// Fibres along the radius of the wheel stiffen an isotropic material: sigma_rr = D e_rr in addition. In the
/// frame of a cell the first axis is radial at its first azimuth.
class Fibres : public IsotropicLaw<2> {
 public:
  Fibres(const Material& between, double stiffness) : IsotropicLaw<2>(between), stiffness_(stiffness) {}

  void stress(const StrainRows<2>& strains, const StressRows<2>& stresses) const override {
    IsotropicLaw<2>::stress(strains, stresses);
    for (size_t i = 0; i < strains[0].size(); ++i) stresses[0][i] += stiffness_ * strains[0][i];
  }
  void tangent(const StrainRows<2>& strains, const TangentRows<2>& tangents) const override {
    IsotropicLaw<2>::tangent(strains, tangents);
    for (double& x : tangents[0][0]) x += stiffness_;
  }
  void energy_density(const StrainRows<2>& strains, std::span<double> densities) const override {
    IsotropicLaw<2>::energy_density(strains, densities);
    for (size_t i = 0; i < densities.size(); ++i)
      densities[i] += 0.5 * stiffness_ * strains[0][i] * strains[0][i];
  }
  const Material* isotropic() const override { return nullptr; }

 private:
  double stiffness_;
};

RollingModel<2> wheel_of(const Materials<2>& materials) {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.materials = materials;
  model.n_positions = 2;
  model.dilatation = DilatationKind::pointwise;  // as for other laws
  return model;
}

struct Solved {
  Evaluation<2> evaluation;
  std::vector<double> peaks;
};

Expected<Solved> solve(const Materials<2>& materials) {
  const auto problem = RollingProblem<2>::create(wheel_of(materials));
  if (!problem) return problem.failure();
  const std::vector<ShapeFunction<2>> functions{
      {.name = "energy", .terms = testing::strain_energy_alone()},
      {.name = "peak", .terms = {{1, std::make_shared<PeakVonMises<2>>(0.02)}}}};
  const LevelSet<2> psi = testing::paper_holes(problem->model().grid);
  const auto solved = evaluate<2>(*problem, functions, psi);
  if (!solved) return solved.failure();
  return Solved{solved->evaluation, solved->state->strain_peaks().von_mises};
}

TEST(MaterialLaw, AnOwnLawGivesTheResultsOfTheSameConstants) {
  const auto polymer = std::make_shared<WarmPolymer>(modulus, ratio, 60);
  const auto own = solve(Materials<2>(polymer)), built_in = solve(Material{polymer->youngs_modulus(), ratio}),
             cold = solve(Materials<2>(std::make_shared<WarmPolymer>(modulus, ratio, 20)));
  ASSERT_TRUE(own && built_in && cold);
  for (size_t f = 0; f < 2; ++f) {
    const auto &a = own->evaluation.functions[f], &b = built_in->evaluation.functions[f];
    EXPECT_NEAR(a.value, b.value, 1e-11 * b.value);
    EXPECT_LT(testing::relative_difference(a.gradient, b.gradient), 1e-9);
  }
  EXPECT_LT(testing::relative_difference(own->peaks, built_in->peaks), 1e-11);
  EXPECT_GT(own->evaluation.functions[0].value, 1.5 * cold->evaluation.functions[0].value);
}

TEST(MaterialLaw, TheShapeGradientIsThatOfAnOwnLaw) {
  const auto problem = RollingProblem<2>::create(
      wheel_of(Materials<2>(std::make_shared<Fibres>(Material{modulus, ratio}, 3 * modulus))));
  ASSERT_TRUE(problem);
  const auto test = testing::generic_taylor_test(*problem, testing::strain_energy_alone());
  ASSERT_TRUE(test);
  for (const double order : test->orders) EXPECT_GT(order, 1.9);
}

/// Its tangent says nothing of the fibres.
class ForgottenFibres : public Fibres {
 public:
  using Fibres::Fibres;
  void tangent(const StrainRows<2>& strains, const TangentRows<2>& tangents) const override {
    IsotropicLaw<2>::tangent(strains, tangents);
  }
};

class Nonlinear : public IsotropicLaw<2> {
 public:
  using IsotropicLaw<2>::IsotropicLaw;
  bool is_linear() const override { return false; }
};

TEST(MaterialLaw, WhatIsNoLinearLawIsRefused) {
  const Material material{modulus, ratio};
  const auto reason = [&](std::shared_ptr<const MaterialLaw<2>> law) {
    const auto problem = RollingProblem<2>::create(wheel_of(Materials<2>(std::move(law))));
    return problem ? std::optional<FailureReason>() : problem.failure().reason;
  };
  EXPECT_EQ(reason(std::make_shared<Fibres>(material, modulus)), std::nullopt);
  EXPECT_EQ(reason(std::make_shared<Nonlinear>(material)), FailureReason::unsupported_model);
  EXPECT_EQ(reason(std::make_shared<ForgottenFibres>(material, modulus)), FailureReason::unsupported_model);
  EXPECT_EQ(reason(std::make_shared<Fibres>(material, -10 * modulus)), FailureReason::unsupported_model);
}

}  // namespace
}  // namespace wheelwright
