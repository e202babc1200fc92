#include "wheelwright/shape/evolution/edge_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

/// Rows of equal height, or of unequal ones that meet in the middle of the hole.
template <int dimension, bool are_equal>
struct Rows {
  static constexpr int value = dimension;

  static Lattice<dimension> lattice() {
    std::vector<FixedLine> lines;
    if (!are_equal) lines = {{13, 0.274}};
    if constexpr (dimension == 2)
      return {{0.20, 0.34, 0.12, 12, {28, 32}, lines}, 2};
    else
      return {{0.20, 0.34, 0.08, 12, {26, 26, 15}, lines}, 2};
  }
};

constexpr double radius = 0.03;

/// A hole around a point off all nodes and planes of symmetry: a disk in 2D, a ball in 3D.
template <class Rows>
LevelSet<Rows::value> round_hole() {
  constexpr int dim = Rows::value;
  const auto lattice = Rows::lattice();
  Vec<dim> centre{0.271, 0.23};
  if constexpr (dim == 3) centre[2] = 0.041;
  const auto middle = cartesian<dim>(centre);
  LevelSet<dim> psi{lattice, {}};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    Vec<dim> x = cartesian<dim>(lattice.polar_point(node));
    for (int d = 0; d < dim; ++d) x[d] -= middle[d];
    psi.values.push_back(radius - norm<dim>(x));
  }
  return psi;
}

/// The jet of some function without symmetry.
template <int dim>
Jet<dim> some_jet() {
  Jet<dim> f{0.1, {}, {}};
  for (int i = 0; i < dim; ++i) {
    f.gradient[i] = 1 + 0.7 * i - 0.9 * i * i;
    for (int j = 0; j < dim; ++j) f.hessian[i][j] = 3 + 2 * (i + j) - 5.5 * i * j + (i == j ? 1.3 * i : 0);
  }
  return f;
}

template <class Size>
class EdgeCurvatureOf : public ::testing::Test {};
using Sizes = ::testing::Types<Rows<2, true>, Rows<3, true>, Rows<2, false>>;
TYPED_TEST_SUITE(EdgeCurvatureOf, Sizes);

}  // namespace

/// The derivatives of the curvature are those of central differences.
TYPED_TEST(EdgeCurvatureOf, HasTheDerivativesOfItsDifferences) {
  constexpr int dim = TypeParam::value;
  constexpr double eps = 1e-5;
  const auto f = some_jet<dim>();
  const auto curvature = principal_curvature(f);
  const auto difference = [&](auto change) {
    Jet<dim> plus = f, minus = f;
    change(plus, eps);
    change(minus, -eps);
    return (principal_curvature(plus).value - principal_curvature(minus).value) / (2 * eps);
  };
  for (int i = 0; i < dim; ++i) {
    EXPECT_NEAR(curvature.by_gradient[i], difference([i](auto& g, double e) { g.gradient[i] += e; }), 1e-7);
    for (int j = 0; j <= i; ++j)
      EXPECT_NEAR(curvature.by_hessian[i][j] + curvature.by_hessian[j][i],
                  difference([i, j](auto& g, double e) {
                    g.hessian[i][j] += e;
                    g.hessian[j][i] += e;
                  }),
                  1e-7);
  }
}

/// The derivative of a jet by the radius, partial derivatives held, is that of its differences.
TYPED_TEST(EdgeCurvatureOf, TheJetChangesWithTheRadiusAsItsDifferencesSay) {
  constexpr int dim = TypeParam::value;
  constexpr double r = 0.7, eps = 1e-5;
  const auto g = some_jet<dim>();
  const PolarPartials<dim> f{.value = 2, .first = g.gradient, .second = g.hessian};
  const auto plus = jet(f, r + eps), minus = jet(f, r - eps), rate = jet_by_radius(f, r);
  for (int i = 0; i < dim; ++i) {
    EXPECT_NEAR(rate.gradient[i], (plus.gradient[i] - minus.gradient[i]) / (2 * eps), 1e-7);
    for (int j = 0; j < dim; ++j)
      EXPECT_NEAR(rate.hessian[i][j], (plus.hessian[i][j] - minus.hessian[i][j]) / (2 * eps), 1e-6);
  }
}

/// A round hole has the curvature of its radius all around; material between holes is no internal corner.
TYPED_TEST(EdgeCurvatureOf, IsThatOfARoundHole) {
  const auto psi = round_hole<TypeParam>();
  const auto coefficients = spline_coefficients(psi);
  const auto corners = internal_corners(coefficients, 0.5 / radius);
  ASSERT_GT(corners.size(), 50u);
  EXPECT_EQ(corners.size(), internal_corners(coefficients, 0.9 / radius).size());
  for (const auto& corner : corners) EXPECT_NEAR(corner.curvature * radius, 1, 0.02);
  EXPECT_TRUE(internal_corners(coefficients, 1.1 / radius).empty());
  auto ball = coefficients;
  for (double& value : ball.values) value = -value;
  EXPECT_TRUE(internal_corners(ball, 0.5 / radius).empty());
}

/// Taylor's test with respect to the coefficients: the curvature at a point that stays on its line, with
/// lines along all axes.
TYPED_TEST(EdgeCurvatureOf, ChangesWithTheCoefficientsAsItsDerivativeSays) {
  constexpr int dim = TypeParam::value;
  const auto coefficients = spline_coefficients(round_hole<TypeParam>());
  const double h = coefficients.lattice.grid().resolution();
  const auto corners = internal_corners(coefficients, 0.5 / radius);
  const auto changed = [&](double step) {
    auto result = coefficients;
    for (int node = 0; node < result.lattice.n_nodes(); ++node) {
      const auto x = result.lattice.polar_point(node);
      result.values[node] +=
          step * h * (0.4 + std::sin(31 * x[0]) * std::cos(12 * x[1] + 0.4) + 3 * x[dim - 1]);
    }
    return result;
  };
  std::array<int, dim> tested{};
  for (std::size_t k = 0; k < corners.size(); k += corners.size() / 25) {
    const auto& corner = corners[k];
    double slope = 0;
    const auto unit = changed(1);
    for (const auto& [node, weight] : curvature_dependence(coefficients, corner))
      slope += weight * (unit.values[node] - coefficients.values[node]);
    const auto curvature_at = [&](double step) {  // of the point of the same line
      double nearest = 1, curvature = 0;
      for (const auto& other : internal_corners(changed(step), 0.5 / radius)) {
        double apart = 0;
        for (int d = 0; d < dim; ++d) {
          const double off = other.cell[d] + other.xi[d] - corner.cell[d] - corner.xi[d];
          if (d == corner.axis)
            apart += std::abs(off);
          else
            apart += off == 0 ? 0 : 10;
        }
        if (other.axis != corner.axis || apart >= nearest) continue;
        nearest = apart;
        curvature = other.curvature;
      }
      return curvature;
    };
    double last = 0;
    for (const double step : {2e-3, 1e-3}) {
      const double plus = curvature_at(step), minus = curvature_at(-step);
      ASSERT_GT(plus, 0);
      ASSERT_GT(minus, 0);
      const double error = std::abs((plus - minus) / (2 * step) - slope);
      EXPECT_LT(error, 0.02 * std::abs(slope) + 0.02 / radius);
      if (last > 1e-6 / radius) {
        EXPECT_GT(std::log2(last / error), 1.5) << k;
      }
      last = error;
    }
    ++tested[corner.axis];
  }
  for (const int count : tested) EXPECT_GE(count, 3);
}
