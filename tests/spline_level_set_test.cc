#include "wheelwright/shape/evolution/spline_level_set.h"

#include <gtest/gtest.h>

#include <random>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

/// Rows of equal height, or of unequal ones.
template <int dimension, bool are_equal>
struct Rows {
  static constexpr int dim = dimension;

  static Lattice<dim> lattice(int degree) {
    std::vector<FixedLine> lines;
    if constexpr (dim == 2) {
      if (!are_equal) lines = {{3, 0.22}, {4, 0.225}, {9, 0.30}, {13, 0.331}};
      return {{0.20, 0.34, 0.12, 12, {14, 17}, lines}, degree};
    } else {
      if (!are_equal) lines = {{2, 0.25}, {3, 0.26}};
      return {{0.20, 0.34, 0.12, 12, {7, 9, 5}, lines}, degree};
    }
  }
};

template <class Rows>
LevelSet<Rows::dim> random_level_set(int degree) {
  std::mt19937 random(11);
  LevelSet<Rows::dim> psi{Rows::lattice(degree), {}};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    psi.values.push_back(std::normal_distribution<double>()(random));
  return psi;
}

template <int dim>
bool is_vertex(const Lattice<dim>& lattice, int node) {
  for (const int x : lattice.node_position(node))
    if (x % lattice.degree() != 0) return false;
  return true;
}

template <class Rows>
class SplineLevelSets : public testing::Test {};
using AllRows = testing::Types<Rows<2, true>, Rows<3, true>, Rows<2, false>, Rows<3, false>>;
TYPED_TEST_SUITE(SplineLevelSets, AllRows);

}  // namespace

TYPED_TEST(SplineLevelSets, HaveTheValuesOfTheVertices) {
  constexpr int dim = TypeParam::dim;
  const auto psi = random_level_set<TypeParam>(2);
  const auto filtered = spline_level_set(spline_coefficients(psi)), coefficients = spline_coefficients(psi);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    if (!is_vertex(psi.lattice, node)) continue;
    EXPECT_NEAR(filtered.values[node], psi.values[node], 1e-13);
    EXPECT_NEAR(spline_coefficients(filtered).values[node], coefficients.values[node], 1e-12);
    if (node > 40) break;
  }
}

TYPED_TEST(SplineLevelSets, ReproduceLinesAlongTheRadius) {
  constexpr int dim = TypeParam::dim;
  LevelSet<dim> psi{TypeParam::lattice(2), {}};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    psi.values.push_back(3 - 2 * psi.lattice.polar_point(node)[0]);
  const auto coefficients = spline_coefficients(psi), shape = spline_level_set(psi);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    EXPECT_NEAR(coefficients.values[node], psi.values[node], 1e-13);
    EXPECT_NEAR(shape.values[node], psi.values[node], 1e-13);
  }
}

/// Coefficients that are clipped give a level set that is: what keeps the bands.
TYPED_TEST(SplineLevelSets, AreMonotoneInTheirCoefficients) {
  constexpr int dim = TypeParam::dim;
  const auto c = random_level_set<TypeParam>(2);
  auto larger = c;
  std::mt19937 random(2);
  for (double& x : larger.values) x += std::exponential_distribution<double>(1)(random);
  const auto psi = spline_level_set(c), above = spline_level_set(larger);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    EXPECT_LE(psi.values[node], above.values[node] + (psi.lattice.node_position(node)[0] == 0 ? 2 : 1e-14));
}

/// Its slope and curvature are continuous along the radius, also where rows of unequal height meet, and its
/// derivatives are those of its differences.
TYPED_TEST(SplineLevelSets, AreSmooth) {
  constexpr int dim = TypeParam::dim;
  const PolarGrid<dim> grid = TypeParam::lattice(2).grid();
  const auto at = [&](int row, double xi, int order) {
    const auto weights = spline_derivative_weights(grid, 0, row, xi)[order];
    const auto [first, count] = spline_support(grid, 0, row);
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += weights[k] * std::sin(7.0 * (first + k));
    return sum / std::pow(grid.row_height(row), order);
  };
  constexpr double eps = 1e-5;
  for (int row = 0; row < grid.cells[0]; ++row) {
    if (row > 0)
      for (const int order : {0, 1, 2}) {
        EXPECT_NEAR(at(row, 0, order) * std::pow(0.01, order), at(row - 1, 1, order) * std::pow(0.01, order),
                    1e-10)
            << row << " " << order;
      }
    for (const int order : {1, 2, 3}) {
      const double difference =
          (at(row, 0.3 + eps, order - 1) - at(row, 0.3 - eps, order - 1)) / (2 * eps * grid.row_height(row));
      EXPECT_NEAR(at(row, 0.3, order) / difference, 1, 1e-5) << row << " " << order;
    }
  }
}

/// The value in a cell, of the polynomial through its nodes, as the weighted sum of the coefficients.
TYPED_TEST(SplineLevelSets, HaveTheWeightsOfTheirCoefficients) {
  constexpr int dim = TypeParam::dim;
  std::mt19937 random(5);
  for (const int degree : {1, 2}) {
    const auto c = random_level_set<TypeParam>(degree);
    const auto psi = spline_level_set(c);
    const auto& lattice = c.lattice;
    const auto& grid = lattice.grid();
    for (int cell = 0; cell < grid.n_cells(); ++cell) {
      const auto position = grid.cell_position(cell);
      Vec<dim> xi;
      for (double& x : xi) x = std::uniform_real_distribution<double>()(random);
      const ShapeFunctions<dim> shape(degree, xi);
      const auto values = psi.cell_values(cell);
      double value = 0, sum = 0;
      for (std::size_t a = 0; a < values.size(); ++a) value += shape.value[a] * values[a];
      std::array<SplineSupport, dim> support;
      int n = 1;
      for (int d = 0; d < dim; ++d) {
        support[d] = spline_support(grid, d, position[d]);
        n *= support[d].count;
      }
      for (int k = 0; k < n; ++k) {
        std::array<int, dim> vertex;
        double weight = 1;
        int rest = k;
        for (int d = 0; d < dim; ++d) {
          const int i = rest % support[d].count;
          rest /= support[d].count;
          weight *= spline_weights(grid, degree, d, position[d], xi[d])[i];
          vertex[d] = degree * (support[d].first + i);
        }
        if (weight != 0) sum += weight * c.values[lattice.node_index(vertex)];
      }
      EXPECT_NEAR(sum, value, 1e-12);
    }
  }
}

/// Edges stay where they are although the distance has kinks midway between them, which a spline rounds off:
/// by less than a hundredth of a cell on average where the distance itself would move them by more.
template <int dim>
void expect_edges_stay_when_redistanced(const Lattice<dim>& lattice) {
  const double h = lattice.grid().resolution();
  auto coefficients = spline_coefficients(make_level_set<dim>(
      lattice, std::vector<Circle>{{0.235, 0.13, 0.018}, {0.271 + 2 * h, 0.14, 0.018}, {0.262, 0.42, 0.03}}));
  for (int node = 0; node < lattice.n_nodes(); ++node)
    coefficients.values[node] *= 1 + 0.7 * std::sin(12 * lattice.polar_point(node)[1]);
  const LevelSet<dim> psi = spline_level_set(coefficients);
  const auto mean_off = [&](const LevelSet<dim>& redistanced) {
    double sum = 0, measure = 0;
    for (const auto& point : boundary_samples<dim>(psi)) {
      const ShapeFunctions<dim> shape(lattice.degree(), point.xi);
      const auto values = redistanced.cell_values(point.cell);
      double value = 0;
      for (std::size_t a = 0; a < values.size(); ++a) value += shape.value[a] * values[a];
      sum += point.weight * std::abs(value);
      measure += point.weight;
    }
    return sum / measure / h;
  };
  const auto distance = redistance(psi);
  const auto redistanced = spline_level_set(redistanced_coefficients(psi));
  EXPECT_LT(mean_off(redistanced), 0.005);
  EXPECT_LT(mean_off(redistanced), 0.3 * mean_off(spline_level_set(distance)));
  for (int node = 0; node < lattice.n_nodes(); ++node)
    EXPECT_NEAR(redistanced.values[node], distance.values[node], 0.5 * h);
}

TEST(SplineLevelSet, KeepsItsEdgesWhenRedistanced) {
  expect_edges_stay_when_redistanced<2>({{0.20, 0.34, 0.12, 12, {28, 32}}, 2});
  expect_edges_stay_when_redistanced<3>({{0.20, 0.34, 0.12, 12, {14, 16, 4}}, 2});
  expect_edges_stay_when_redistanced<2>({{0.20, 0.34, 0.12, 12, {28, 32}, {{11, 0.262}, {17, 0.280}}}, 2});
}
