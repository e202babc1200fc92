#include "wheelwright/shape/evolution/spline_level_set.h"

#include <gtest/gtest.h>

#include <random>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

template <int dim>
Lattice<dim> lattice_of(int degree) {
  if constexpr (dim == 2)
    return {{0.20, 0.34, 0.12, 12, {14, 17}}, degree};
  else
    return {{0.20, 0.34, 0.12, 12, {7, 9, 5}}, degree};
}

template <int dim>
LevelSet<dim> random_level_set(int degree) {
  std::mt19937 random(11);
  LevelSet<dim> psi{lattice_of<dim>(degree), {}};
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

template <class Dimension>
class SplineLevelSets : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SplineLevelSets, Dimensions);

}  // namespace

TYPED_TEST(SplineLevelSets, HaveTheValuesOfTheVertices) {
  constexpr int dim = TypeParam::value;
  const auto psi = random_level_set<dim>(2);
  const auto filtered = spline_level_set(spline_coefficients(psi)), coefficients = spline_coefficients(psi);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    if (!is_vertex(psi.lattice, node)) continue;
    EXPECT_NEAR(filtered.values[node], psi.values[node], 1e-13);
    EXPECT_NEAR(spline_coefficients(filtered).values[node], coefficients.values[node], 1e-12);
    if (node > 40) break;
  }
}

TYPED_TEST(SplineLevelSets, ReproduceLinesAlongTheRadius) {
  constexpr int dim = TypeParam::value;
  LevelSet<dim> psi{lattice_of<dim>(2), {}};
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
  constexpr int dim = TypeParam::value;
  const auto c = random_level_set<dim>(2);
  auto larger = c;
  std::mt19937 random(2);
  for (double& x : larger.values) x += std::exponential_distribution<double>(1)(random);
  const auto psi = spline_level_set(c), above = spline_level_set(larger);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    EXPECT_LE(psi.values[node], above.values[node] + (psi.lattice.node_position(node)[0] == 0 ? 2 : 1e-14));
}

/// The value in a cell, of the polynomial through its nodes, as the weighted sum of the coefficients.
TYPED_TEST(SplineLevelSets, HaveTheWeightsOfTheirCoefficients) {
  constexpr int dim = TypeParam::value;
  std::mt19937 random(5);
  for (const int degree : {1, 2}) {
    const auto c = random_level_set<dim>(degree);
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
      for (int k = 0; k < power(4, dim); ++k) {
        std::array<int, dim> vertex;
        double weight = 1;
        int rest = k;
        for (int d = 0; d < dim; ++d, rest /= 4) {
          weight *= spline_weights(degree, position[d], xi[d], grid.cells[d] + 1, d == 1)[rest % 4];
          vertex[d] = degree * (position[d] + rest % 4 - 1);
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
}
