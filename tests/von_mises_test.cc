#include "wheelwright/mechanics/elasticity/von_mises.h"

#include <gtest/gtest.h>

#include <random>

namespace wheelwright {
namespace {

template <int dim>
void expect_slopes(double axial_strain_ratio) {
  std::mt19937_64 random(dim);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 50; ++k) {
    Voigt<dim> strain;
    for (double& e : strain) e = normal(random);
    const SquaredDeviator<dim> deviator(strain.data(), axial_strain_ratio);
    const auto slopes = deviator.by_strain();
    for (int i = 0; i < n_strains<dim>; ++i) {
      constexpr double h = 1e-5;
      Voigt<dim> more = strain, less = strain;
      more[i] += h;
      less[i] -= h;
      const double difference = (SquaredDeviator<dim>(more.data(), axial_strain_ratio).value -
                                 SquaredDeviator<dim>(less.data(), axial_strain_ratio).value) /
                                (2 * h);
      EXPECT_NEAR(slopes[i], difference, 1e-8) << i;
    }
  }
}

TEST(SquaredDeviator, HasTheSlopesOfItsDifferences) {
  for (const double ratio : {0.0, -0.3, -0.9}) expect_slopes<2>(ratio);
  expect_slopes<3>(0);
}

// It is that of three dimensions with the axial strain that the plane state has, and does not know pressure.
TEST(SquaredDeviator, InThePlaneIsThatOfTheWholeStrain) {
  const double ratio = -0.4;
  const double plane[3] = {0.3, -0.7, 0.25}, whole[6] = {0.3, -0.7, ratio * (0.3 - 0.7), 0, 0, 0.25};
  double in_3d = 0;
  for (int order = 0; order < 3; ++order) {  // the shear strain may be that of any plane
    double turned[6] = {};
    for (int k = 0; k < 3; ++k) {
      turned[k] = whole[(k + order) % 3];
      turned[3 + k] = whole[3 + (k + order) % 3];
    }
    in_3d = SquaredDeviator<3>(turned, 0).value;
    EXPECT_NEAR(SquaredDeviator<2>(plane, ratio).value, in_3d, 1e-15);
    for (int k = 0; k < 3; ++k) turned[k] += 0.6;
    EXPECT_NEAR(SquaredDeviator<3>(turned, 0).value, in_3d, 1e-15);
  }
}

}  // namespace
}  // namespace wheelwright
