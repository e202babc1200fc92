#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/closest_point.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/multilinear.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/evolution/sub_cell_filter.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/nearest_point.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

constexpr double hole_radius = 0.04;
const std::vector<Circle> one_hole{{0.27, std::numbers::pi / 16, hole_radius}};

/// One sector of 16; refinement 1 is the grid of 28 x 384 cells.
Lattice<2> lattice_of(int degree, double refinement = 1) {
  return {{0.20, 0.34, 0.12, 16, {int(28 * refinement), int(24 * refinement)}}, degree};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

/// A copy moved by whole azimuth nodes.
std::vector<double> turned(const Lattice<2>& lattice, const std::vector<double>& values, int n_lines) {
  std::vector<double> result(values.size());
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    auto p = lattice.node_position(node);
    p[1] += n_lines;
    result[lattice.node_index(p)] = values[node];
  }
  return result;
}

Vec<2> polar_of(const Lattice<2>& lattice, const Vec<2>& point) {
  return {lattice.grid().inner_radius + point[0] * lattice.spacing(0)[0], point[1] * lattice.node_angle()};
}

/// Largest | signed distance to `circle` | over the zero line.
double zero_line_error(const LevelSet<2>& psi, const Circle& circle) {
  double error = 0;
  for (const auto& seed : zero_seeds<2>(CubicInterpolant<2>(psi)))
    error = std::max(
        error, std::abs(signed_distance<2>(psi.lattice.grid(), {&circle, 1}, polar_of(psi.lattice, seed))));
  return error;
}

/// The same over the quadrature points of the cells' own polynomials: the boundary that the physics sees.
double boundary_error(const LevelSet<2>& psi, const Circle& circle) {
  const auto& grid = psi.lattice.grid();
  double error = 0;
  for (const auto& sample : boundary_samples<2>(psi)) {
    const auto cell = grid.cell_position(sample.cell);
    const Vec<2> polar{grid.radius(cell[0] + sample.xi[0]), (cell[1] + sample.xi[1]) * grid.column_angle()};
    error = std::max(error, std::abs(signed_distance<2>(grid, {&circle, 1}, polar)));
  }
  return error;
}

/// psi with its gradient spoilt by 50 % and its zero line kept.
LevelSet<2> distorted(LevelSet<2> psi) {
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const Vec<2> x = psi.lattice.polar_point(node);
    psi.values[node] *= 1 + 0.5 * std::sin(60 * x[0]) * std::cos(32 * x[1]);
  }
  return psi;
}

std::vector<SurfaceSample<2>> some_gradient(const LevelSet<2>& psi) {
  auto samples = boundary_samples<2>(psi);
  for (auto& sample : samples) sample.value = -1 - sample.normal[0] * sample.normal[1] - sample.normal[1];
  return samples;
}

// --- the fixed linear systems ---

TEST(SparseSpd, SolvesToRoundOff) {
  const auto lattice = lattice_of(1);
  const auto matrix = multilinear_form<2>(lattice, 1, 1e-4);
  const auto factor = SparseSpd::factor(lattice.n_nodes(), matrix);
  ASSERT_TRUE(factor);
  std::mt19937 random(2);
  std::vector<double> b(lattice.n_nodes());
  for (double& x : b) x = std::normal_distribution<double>()(random);
  EXPECT_LT(largest_difference(symmetric_product(matrix, factor->solve(b)), b), 1e-12);
}

TEST(SparseSpd, NamesAnIndefiniteMatrix) {
  const std::vector<SparseSpd::Entry> matrix{{0, 0, 1}, {1, 0, 2}, {1, 1, 1}};
  const auto factor = SparseSpd::factor(2, matrix);
  ASSERT_FALSE(factor);
  EXPECT_EQ(factor.failure().reason, FailureReason::not_positive_definite);
}

TEST(MultilinearForm, IntegratesAreaAndLinearFunctions) {
  const auto lattice = lattice_of(2);
  const auto& grid = lattice.grid();
  const std::vector<double> ones(lattice.n_nodes(), 1.0);
  std::vector<double> radius(lattice.n_nodes());
  for (int node = 0; node < lattice.n_nodes(); ++node) radius[node] = lattice.polar_point(node)[0];
  const auto energy = [](const std::vector<SparseSpd::Entry>& form, const std::vector<double>& v) {
    const auto product = symmetric_product(form, v);
    return std::inner_product(v.begin(), v.end(), product.begin(), 0.0);
  };
  const double area = sector_measure<2>(grid);
  EXPECT_NEAR(energy(multilinear_form<2>(lattice, 1, 0), ones), area, 1e-12 * area);
  EXPECT_NEAR(energy(multilinear_form<2>(lattice, 0, 1), ones), 0, 1e-12);
  EXPECT_NEAR(energy(multilinear_form<2>(lattice, 0, 1), radius), area, 1e-12 * area);
}

// --- velocity ---

class Velocity : public testing::TestWithParam<ExtensionKind> {};

TEST_P(Velocity, VanishesInTheBandsAndDescends) {
  const auto lattice = lattice_of(2);
  const ProtectedBands<2> bands(lattice, {{0.012, 1}, {0.006, 1}});
  const auto extension = make_velocity_extension<2>(lattice, bands, {GetParam(), 2});
  const auto gradient = some_gradient(make_level_set<2>(lattice, one_hole));
  const auto velocity = *(*extension)(gradient);
  double slope = 0;
  for (const auto& sample : gradient) {
    auto weighted = sample;
    weighted.weight *= sample.value;
    slope += boundary_integral<2>(lattice, {&weighted, 1}, velocity);
  }
  EXPECT_LT(slope, 0);
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const double radius = lattice.polar_point(node)[0];
    EXPECT_EQ(bands.nodes()[node], radius < 0.212 - 1e-9 || radius > 0.334 + 1e-9);
    if (bands.nodes()[node]) {
      EXPECT_EQ(velocity[node], 0);
    }
  }
}

TEST_P(Velocity, CanPreserveTheMeasureToFirstOrder) {
  const auto lattice = lattice_of(2);
  const auto psi = make_level_set<2>(lattice, one_hole);
  const ProtectedBands<2> bands(lattice, {{0.012, 1}, {0.006, 1}});
  const auto extension = make_velocity_extension<2>(lattice, bands, {GetParam(), 2});
  const auto gradient = some_gradient(psi);
  const auto velocity = *measure_preserving_velocity<2>(lattice, *extension, gradient);
  const double length = 2 * std::numbers::pi * hole_radius;
  double fastest = 0;
  for (double v : velocity) fastest = std::max(fastest, std::abs(v));
  EXPECT_LT(std::abs(boundary_integral<2>(lattice, gradient, velocity)), 1e-12 * fastest * length);
  // The measure itself changes at second order in the distance moved.
  const auto change = [&](double distance) {
    return std::abs(material_measure(transport<2>(psi, velocity, distance / fastest)) -
                    material_measure(psi));
  };
  const double h = lattice.grid().resolution();
  EXPECT_LT(change(0.1 * h), 0.02 * 0.1 * h * length);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Velocity, testing::Values(ExtensionKind::h1, ExtensionKind::harmonic));

TEST(H1Velocity, HasAnEnergyThatEqualsTheDescent) {
  const auto lattice = lattice_of(2);
  const ProtectedBands<2> bands(lattice, {{0.01, 1}, {0.01, 1}});
  const auto gradient = some_gradient(make_level_set<2>(lattice, one_hole));
  const auto velocity = *(*make_velocity_extension<2>(lattice, bands, {ExtensionKind::h1, 2}))(gradient);
  const double length = 2 * lattice.grid().resolution();
  const auto product = symmetric_product(multilinear_form<2>(lattice, 1, length * length), velocity);
  const double energy = std::inner_product(velocity.begin(), velocity.end(), product.begin(), 0.0);
  const auto load = boundary_load<2>(lattice, gradient);
  const double descent = -std::inner_product(velocity.begin(), velocity.end(), load.begin(), 0.0);
  EXPECT_GT(energy, 0);
  EXPECT_NEAR(energy, descent, 1e-10 * energy);
}

TEST(HarmonicVelocity, TakesTheNegativeGradientOnTheBoundary) {
  const auto lattice = lattice_of(2);
  const ProtectedBands<2> bands(lattice, {{0.005, 1}, {0.005, 1}});
  const auto gradient = some_gradient(make_level_set<2>(lattice, one_hole));
  const auto velocity =
      *(*make_velocity_extension<2>(lattice, bands, {ExtensionKind::harmonic, 2}))(gradient);
  for (auto sample : gradient) {
    sample.weight = 1;
    EXPECT_NEAR((boundary_integral<2>(lattice, {&sample, 1}, velocity)), -sample.value, 0.15);
  }
}

// --- transport ---

TEST(Transport, MovesACircleAtUnitSpeedWithSecondOrder) {
  for (double sign : {1.0, -1.0}) {
    const double time = 0.012;
    const Circle moved{0.27, std::numbers::pi / 16, 0.03 - sign * time};
    std::vector<double> errors;
    for (double refinement : {1.0, 2.0, 4.0}) {
      const auto lattice = lattice_of(2, refinement);
      auto psi = make_level_set<2>(lattice, std::vector<Circle>{{0.27, std::numbers::pi / 16, 0.03}});
      for (double& value : psi.values) value *= sign;
      const std::vector<double> unit(lattice.n_nodes(), 1.0);
      errors.push_back(zero_line_error(transport<2>(psi, unit, time), moved));
    }
    RecordProperty(sign > 0 ? "hole" : "disc", testing::PrintToString(errors));
    EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
    EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
  }
}

TEST(Transport, KeepsNodesWithoutVelocity) {
  const auto lattice = lattice_of(2);
  const auto psi = make_level_set<2>(lattice, one_hole);
  EXPECT_EQ(transport<2>(psi, std::vector<double>(lattice.n_nodes()), 1).values, psi.values);
}

// --- nearest points ---

/// By comparison with all points; the first of those that are equally near.
template <int dim>
int index_of_nearest_by_comparison(const std::vector<Vec<dim>>& points, const Vec<dim>& x) {
  int nearest = 0;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    double distance2 = 0;
    for (int d = 0; d < dim; ++d) distance2 += (x[d] - points[k][d]) * (x[d] - points[k][d]);
    if (distance2 >= shortest) continue;
    nearest = k;
    shortest = distance2;
  }
  return nearest;
}

/// Points on a lattice of halves, most of them several times, so that nearly every query has ties, and all
/// distances are exact.
template <int dim>
void expect_the_first_of_the_nearest(int n_points) {
  std::mt19937 random(n_points);
  std::uniform_int_distribution<int> coordinate(-6, 6);
  const auto draw = [&](double unit) {
    Vec<dim> x;
    for (double& component : x) component = unit * coordinate(random);
    return x;
  };
  std::vector<Vec<dim>> points;
  for (int k = 0; k < n_points; ++k) points.push_back(draw(0.5));
  const NearestPoint<dim> nearest(points);
  for (int query = 0; query < 500; ++query) {
    const Vec<dim> x = draw(0.75);
    EXPECT_EQ(nearest.index_of_nearest(x), index_of_nearest_by_comparison<dim>(points, x));
  }
}

TEST(NearestPoint, IsTheFirstOfEquallyNearPoints) {
  for (const int n_points : {1, 2, 11, 100, 1000}) {
    expect_the_first_of_the_nearest<2>(n_points);
    expect_the_first_of_the_nearest<3>(n_points);
  }
}

// --- redistancing ---

/// Largest | |grad psi| - 1 | of the cell polynomials within three cells of the zero line; for degree 1,
/// whose gradient is of first order elsewhere, at the cells' centres.
double gradient_error(const LevelSet<2>& psi) {
  const auto& lattice = psi.lattice;
  const auto& grid = lattice.grid();
  const double band = 3 * grid.resolution();
  double error = 0;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const auto values = psi.cell_values(cell);
    const auto position = grid.cell_position(cell);
    const int per_axis = lattice.degree() == 1 ? 1 : 3;
    for (int sample = 0; sample < per_axis * per_axis; ++sample) {
      const Vec<2> xi{(sample % per_axis + 0.5) / per_axis, (sample / per_axis + 0.5) / per_axis};
      const ShapeFunctions<2> shape(lattice.degree(), xi);
      double value = 0;
      Vec<2> gradient{};
      for (std::size_t a = 0; a < values.size(); ++a) {
        value += values[a] * shape.value[a];
        for (int d = 0; d < 2; ++d) gradient[d] += values[a] * shape.gradient[a][d];
      }
      const double radius = grid.radius(position[0] + xi[0]);
      gradient[0] /= grid.row_height(0);
      gradient[1] /= grid.column_angle() * radius;
      if (std::abs(value) < band) error = std::max(error, std::abs(norm<2>(gradient) - 1));
    }
  }
  return error;
}

class Redistancing : public testing::TestWithParam<int> {};

TEST_P(Redistancing, GivesUnitGradientAndKeepsTheZeroLine) {
  const auto lattice = lattice_of(GetParam());
  // A narrower hole, so that the medial axis between neighbours stays out of the band.
  const std::vector<Circle> hole{{0.27, 0.01, 0.033}};
  const auto before = distorted(make_level_set<2>(lattice, hole));
  const auto after = redistance<2>(before);
  const double h = lattice.grid().resolution();
  const double start = zero_line_error(before, hole[0]);
  EXPECT_LT(gradient_error(after), 0.02);
  EXPECT_LT(zero_line_error(after, hole[0]), start + 0.005 * h);
  EXPECT_LT(boundary_error(after, hole[0]), boundary_error(before, hole[0]) + 0.02 * h);
  for (std::size_t node = 0; node < after.values.size(); ++node)
    EXPECT_EQ(after.values[node] < 0, before.values[node] < 0);
  RecordProperty("gradient", testing::PrintToString(gradient_error(after)));
  RecordProperty("line_before", testing::PrintToString(start / h));
  RecordProperty("line_after", testing::PrintToString(zero_line_error(after, hole[0]) / h));
  RecordProperty("boundary_before", testing::PrintToString(boundary_error(before, hole[0]) / h));
  RecordProperty("boundary_after", testing::PrintToString(boundary_error(after, hole[0]) / h));
}

TEST_P(Redistancing, HardlyDriftsInAHundredCalls) {
  const auto lattice = lattice_of(GetParam());
  const std::vector<Circle> hole{{0.27, 0.01, 0.033}};
  auto psi = redistance<2>(distorted(make_level_set<2>(lattice, hole)));
  const double h = lattice.grid().resolution();
  const double measure = material_measure(psi), error = boundary_error(psi, hole[0]);
  for (int call = 0; call < 100; ++call) psi = redistance<2>(psi);
  EXPECT_LT(boundary_error(psi, hole[0]), error + 0.05 * h);
  EXPECT_LT(std::abs(material_measure(psi) - measure), 0.02 * h * 2 * std::numbers::pi * 0.033);
  RecordProperty("boundary_first", testing::PrintToString(error / h));
  RecordProperty("boundary_last", testing::PrintToString(boundary_error(psi, hole[0]) / h));
}

TEST_P(Redistancing, KeepsAnExactDistanceOnAnExactDistance) {
  const auto lattice = lattice_of(GetParam());
  // Two holes, one of them across the sector's face.
  const std::vector<Circle> holes{{0.25, 0.0, 0.025}, {0.30, 0.2, 0.015}};
  const auto psi = make_level_set<2>(lattice, holes);
  EXPECT_LT(largest_difference(redistance<2>(psi).values, psi.values), 0.01 * lattice.grid().resolution());
}

TEST_P(Redistancing, ReturnsAFullRingUnchanged) {
  const auto psi = make_level_set<2>(lattice_of(GetParam()), {});
  EXPECT_EQ(redistance<2>(psi).values, psi.values);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Redistancing, testing::Values(1, 2));

TEST(Redistancing3D, KeepsAnExactDistanceOfCylinders) {
  const Lattice<3> lattice({0.20, 0.34, 0.12, 16, {12, 10, 4}}, 2);
  const auto psi = make_level_set<3>(lattice, one_hole);
  EXPECT_LT(largest_difference(redistance<3>(psi).values, psi.values), 0.02 * lattice.grid().resolution());
}

// --- smoothing ---

TEST(Smoothing, KeepsTheMeanAndDampsShortWaves) {
  const auto lattice = lattice_of(2);
  auto psi = make_level_set<2>(lattice, one_hole);
  std::mt19937 random(3);
  for (double& value : psi.values) value += 1e-3 * std::normal_distribution<double>()(random);
  const double length = lattice.grid().resolution();
  const auto smooth = Smoother<2>(lattice, length)(psi);
  const auto energy = [&](const LevelSet<2>& f, double mass, double stiffness) {
    const auto product = symmetric_product(multilinear_form<2>(lattice, mass, stiffness), f.values);
    return std::inner_product(f.values.begin(), f.values.end(), product.begin(), 0.0);
  };
  const auto mean = [&](const LevelSet<2>& f) {
    const auto product = symmetric_product(multilinear_form<2>(lattice, 1, 0), f.values);
    return std::accumulate(product.begin(), product.end(), 0.0);
  };
  EXPECT_NEAR(mean(smooth), mean(psi), 1e-12 * std::abs(mean(psi)));
  EXPECT_LT(energy(smooth, 0, 1), energy(psi, 0, 1));
  // (76): the minimum is no larger than the value at psi itself.
  LevelSet<2> change = smooth;
  for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] -= psi.values[i];
  EXPECT_LT(energy(change, 1, 0) + length * length * energy(smooth, 0, 1),
            length * length * energy(psi, 0, 1));
}

// --- measure and bands ---

ShapeOfShift<2> shifts_of(const LevelSet<2>& psi, const ProtectedBands<2>& bands) {
  return [&](double shift) { return bands.keep(shifted<2>(psi, bands, shift)); };
}

TEST(MeasureByShift, ReachesTheTarget) {
  for (int degree : {1, 2}) {
    const auto lattice = lattice_of(degree);
    const ProtectedBands<2> bands(lattice, {{0.01, 1}, {0.01, 1}});
    const auto psi = make_level_set<2>(lattice, one_hole);
    for (double factor : {0.97, 0.9999, 1.0, 1.01, 1.15}) {
      const double target = factor * material_measure(psi);
      const auto shifted =
          with_measure<2>(shifts_of(psi, bands), target, 2 * std::numbers::pi * hole_radius, 4);
      ASSERT_TRUE(shifted) << factor;
      EXPECT_NEAR(material_measure(shifted->shape), target, 1e-6 * target);
      EXPECT_EQ(shifted->measure, material_measure(shifted->shape));
      for (int node = 0; node < lattice.n_nodes(); ++node)
        if (bands.nodes()[node]) {
          EXPECT_LT(shifted->shape.values[node], 0);
        }
    }
  }
}

TEST(MeasureByShift, NamesAnUnreachableTarget) {
  const auto lattice = lattice_of(2);
  const ProtectedBands<2> bands(lattice, {{0.01, 1}, {0.01, 1}});
  const auto psi = make_level_set<2>(lattice, one_hole);
  const auto shifted =
      with_measure<2>(shifts_of(psi, bands), 1.5 * sector_measure<2>(lattice.grid()), 0.25, 4);
  ASSERT_FALSE(shifted);
  EXPECT_EQ(shifted.failure().reason, FailureReason::empty_shape);
}

TEST(ProtectedBands, CutHolesOffAtTheirEdges) {
  const auto lattice = lattice_of(2);
  const ProtectedBands<2> bands(lattice, {{0.0125, 1}, {0.0375, 1}});
  const auto psi = make_level_set<2>(lattice, one_hole);
  const auto kept = bands.keep(psi);
  const auto& grid = lattice.grid();
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    EXPECT_LE(kept.values[node], psi.values[node]);
    const double radius = lattice.polar_point(node)[0];
    if (radius < 0.2125 || radius > 0.3025) {
      EXPECT_LT(kept.values[node], 0);
    }
  }
  for (const auto& sample : boundary_samples<2>(kept)) {
    const auto cell = grid.cell_position(sample.cell);
    const double radius = grid.radius(cell[0] + sample.xi[0]);
    EXPECT_GT(radius, 0.2125);
    EXPECT_LT(radius, 0.3025);
  }
}

TEST(ProtectedBands, StayFullCellsUnderHolesThatOverlapThem) {
  for (int degree : {1, 2}) {
    const auto lattice = lattice_of(degree);
    const ProtectedBands<2> bands(lattice, {{0.005, 1}, {0.01, 2}});
    for (double shift : {0.0, 0.0007, 0.0013, 0.0021}) {
      const std::vector<Circle> holes{{0.215 + shift, 0.1 + shift, 0.03}, {0.33 - shift, 0.3, 0.02 + shift}};
      const auto domain = cut_domain<2>(bands.keep(make_level_set<2>(lattice, holes)), 4);
      ASSERT_TRUE(domain);
      for (int cell = 0; cell < lattice.grid().n_cells(); ++cell) {
        const int row = lattice.grid().cell_position(cell)[0];
        if (row == 0 || row >= 26) {
          EXPECT_EQ(domain->kinds[cell], CellKind::inside);
        }
      }
    }
  }
}

// Holes that touch the bands keep their measure, whether the bands end on a line of the grid or not.
TEST(ProtectedBands, ChangeNoShapeThatRespectsThem) {
  for (int degree : {1, 2}) {
    const auto lattice = lattice_of(degree);
    for (const double rim : {0.0056, 0.006, 0.0083, 0.01, 0.0151})
      for (const double tread : {0.0106, 0.013, 0.015, 0.02}) {
        const double inner = 0.2 + rim, outer = 0.34 - tread, radius = 0.5 * (outer - inner);
        const auto psi = make_level_set<2>(lattice, std::vector<Circle>{{inner + radius, 0.2, radius}});
        const ProtectedBands<2> bands(lattice, {{rim, 1}, {tread, 2}});
        const double full = material_measure(psi);
        EXPECT_NEAR(material_measure(bands.keep(psi)), full, 1e-6 * full) << rim << " " << tread;
      }
  }
}

TEST(ProtectedBands, StopTheBoundary) {
  const auto lattice = lattice_of(2);
  const Evolver<2> evolver(lattice, {{ExtensionKind::h1, 2}, 0, {{0.04, 1}, {0.01, 1}}, {}});
  const auto psi = evolver.keep_bands(make_level_set<2>(lattice, one_hole));
  auto gradient = boundary_samples<2>(psi);
  const ProtectedBands<2> bands(lattice, {{0.04, 1}, {0.01, 1}});
  std::vector<SurfaceSample<2>> elsewhere;
  int n_touching = 0;
  for (auto& sample : gradient) {
    sample.value = bands.touches(sample) ? 100 : 1;
    n_touching += bands.touches(sample);
    if (!bands.touches(sample)) elsewhere.push_back(sample);
  }
  EXPECT_GT(n_touching, 10);
  EXPECT_EQ(*evolver.velocity(gradient), *evolver.velocity(elsewhere));
}

TEST(Evolver3D, MovesAShapeAndRestoresItsMeasure) {
  const Lattice<3> lattice({0.20, 0.34, 0.12, 16, {10, 8, 3}}, 1);
  const Evolver<3> evolver(lattice, {{ExtensionKind::h1, 2}, 0.1, {{0.014, 1}, {0.014, 1}}, {}});
  const auto psi = make_level_set<3>(lattice, one_hole);
  auto gradient = boundary_samples<3>(psi);
  double area = 0;
  for (auto& sample : gradient) {
    sample.value = -1 - sample.normal[1];
    area += sample.weight;
  }
  const auto velocity = *evolver.measure_preserving_velocity(gradient);
  const double h = lattice.grid().resolution(), measure = material_measure(psi);
  const auto moved = evolver.smooth(*evolver.redistance(*evolver.move(psi, velocity, 0.5 * h)));
  ASSERT_TRUE(moved);
  const auto restored = evolver.with_measure(*moved, measure, area);
  ASSERT_TRUE(restored);
  EXPECT_NEAR(material_measure(restored->shape), measure, 1e-6 * measure);
}

/// The largest change of a level set by a motion over 1e-12 cells, after a motion and a shift to a smaller
/// and to a larger measure, in cells. The holes touch the bands.
template <int dim>
double change_by_a_move_by_nothing(const PolarGrid<dim>& grid, const Bands& bands, bool redistances) {
  const Lattice<dim> lattice(grid, 2);
  EvolutionOptions options{.velocity = {ExtensionKind::h1, 2}, .bands = bands};
  options.space = ShapeSpace::spline;
  const Evolver<dim> evolver(lattice, options);
  const double h = grid.resolution();
  std::vector<double> velocity;
  for (int node = 0; node < lattice.n_nodes(); ++node)
    velocity.push_back(std::cos(grid.n_sectors * lattice.polar_point(node)[1] + 0.4));
  const std::vector<Circle> holes{{0.24, 0.15, 0.03}, {0.31, 0.28, 0.022}};
  LevelSet<dim> psi = *evolver.move(make_level_set<dim>(lattice, holes), velocity, 0.3 * h);
  if (redistances) psi = *evolver.redistance(psi);
  const double before = material_measure(psi);
  double result = 0;
  for (const double factor : {0.99, 1.02}) {
    psi = evolver.with_measure(psi, factor * before, 0.3)->shape;
    result = std::max(result, largest_difference(psi.values, evolver.move(psi, velocity, 1e-12 * h)->values));
  }
  return result / h;
}

// Otherwise the objective jumps at the beginning of a step, and steps that gain less than this are rejected.
TEST(Evolver, MovesAShapeOfAGivenMeasureByNothingIfItIsToMoveByNothing) {
  const Bands bands{{0.01, 1}, {0.012, 1}}, rings{{0.01, 1}, {0.012, 1}, {{0.262, 0.275}}};
  for (const bool redistances : {false, true}) {
    EXPECT_LT(change_by_a_move_by_nothing<2>({0.20, 0.34, 0.12, 16, {28, 24}}, bands, redistances), 1e-9);
    EXPECT_LT(change_by_a_move_by_nothing<2>({0.20, 0.34, 0.12, 16, {28, 24}}, rings, redistances), 1e-9);
    EXPECT_LT(change_by_a_move_by_nothing<2>({0.20, 0.34, 0.12, 16, {28, 24}, {{2, 0.21}, {25, 0.328}}},
                                             bands, redistances),
              1e-9);
    EXPECT_LT(change_by_a_move_by_nothing<3>({0.20, 0.34, 0.12, 16, {14, 12, 4}}, bands, redistances), 1e-9);
  }
}

/// The largest change of a drawn level set with holes up to a band, when its measure is to change by a
/// relative 1e-4, in units of the shift of its whole boundary that would do it; NaN if that fails.
template <int dim>
double shift_for_a_small_change(const PolarGrid<dim>& grid, double factor) {
  const Lattice<dim> lattice(grid, 2);
  EvolutionOptions options{.velocity = {ExtensionKind::h1, 2}, .bands = {{0.01, 1}, {0.012, 1}}};
  options.space = ShapeSpace::spline;
  const Evolver<dim> evolver(lattice, options);
  const std::vector<Circle> holes{{0.255, 0.15, 0.05}};  // 5 mm into the band
  const LevelSet<dim> psi = evolver.keep_bands(make_level_set<dim>(lattice, holes));
  const double measure = material_measure(psi);
  double boundary = 0;
  for (const auto& sample : boundary_samples<dim>(psi)) boundary += sample.weight;
  const auto shifted = evolver.with_measure(psi, factor * measure, boundary);
  if (!shifted) return NAN;
  EXPECT_NEAR(shifted->measure, factor * measure, 1e-6 * measure);
  return largest_difference(psi.values, shifted->shape.values) * boundary / (std::abs(factor - 1) * measure);
}

// If the measure jumped at the shift 0, shapes just above or below their target could not be started from.
TEST(Evolver, ShiftsDrawnShapesAtBandsByLittleIfTheirMeasureIsToChangeByLittle) {
  for (const double factor : {1 - 1e-4, 1 + 1e-4}) {
    EXPECT_LT(shift_for_a_small_change<2>({0.20, 0.34, 0.12, 12, {12, 16}}, factor), 2) << factor;
    EXPECT_LT(shift_for_a_small_change<3>({0.20, 0.34, 0.12, 12, {12, 16, 3}}, factor), 2) << factor;
  }
}

TEST(Evolver, RepairsShapesWithinTheSpaceOfItsMoves) {
  const Lattice<2> lattice = lattice_of(2);
  EvolutionOptions options{.velocity = {ExtensionKind::h1, 2}, .bands = {{0.01, 1}, {0.01, 1}}};
  options.space = ShapeSpace::spline;
  const Evolver<2> evolver(lattice, options);
  const double h = lattice.grid().resolution();
  const std::vector<double> outwards(lattice.n_nodes(), 1.0);
  const auto change = [&](const LevelSet<2>& psi) {
    return largest_difference(psi.values, evolver.move(psi, outwards, 1e-12 * h)->values) / h;
  };
  const std::vector<Circle> near{{0.25, 0.1, 0.03}, {0.25, 0.353, 0.03}}, larger{{0.27, 0.2, 0.04}};
  const auto thin = make_level_set<2>(lattice, near);
  const auto thick = evolver.measured(thin, {.wall = 0.011, .gap = 0.012});
  ASSERT_TRUE(thick) << thick.failure().detail;
  EXPECT_GT(largest_difference(thick->shape.values, thin.values), 0.1 * h);
  EXPECT_LT(change(thick->shape), 1e-9);
  LevelSet<2> with_island = make_level_set<2>(lattice, larger);
  const auto island = make_level_set<2>(lattice, std::vector<Circle>{{0.27, 0.2, 0.01}});
  for (std::size_t n = 0; n < island.values.size(); ++n)
    with_island.values[n] = std::min(with_island.values[n], -island.values[n]);
  const auto attached = evolver.without_islands(with_island, 1);
  ASSERT_TRUE(attached);
  EXPECT_EQ(attached->removed.size(), 1u);
  EXPECT_LT(change(attached->psi), 1e-9);
}

TEST(ProportionalMultiplier, IsTheFormulaOfThePaper) {
  std::vector<SurfaceSample<2>> samples(3);
  for (int k = 0; k < 3; ++k) samples[k].value = k * k;
  EXPECT_DOUBLE_EQ(proportional_multiplier<2>(samples, 0.6, 0.55), 8 * 4 * (0.6 - 0.55));
}

// --- invariance ---

TEST(SubCellFilter, RemovesBulgesOfSingleCellsAndKeepsTheBoundary) {
  for (double refinement : {1.0, 2.0}) {
    const auto lattice = lattice_of(2, refinement);
    const double h = lattice.grid().resolution();
    const auto circle = make_level_set<2>(lattice, one_hole);
    auto bulged = circle;
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const auto p = lattice.node_position(node);
      if (p[0] % 2 != 0 || p[1] % 2 != 0) bulged.values[node] += 0.02 * h;
    }
    EXPECT_GT(boundary_error(bulged, one_hole[0]), 0.015 * h);
    EXPECT_LT(boundary_error(sub_cell_filter(bulged), one_hole[0]), 2e-3 * h / refinement);
    const double hole = sector_measure<2>(lattice.grid()) - material_measure(circle);
    EXPECT_NEAR(material_measure(sub_cell_filter(circle)), material_measure(circle),
                2e-5 * hole / (refinement * refinement));
  }
}

TEST(SubCellFilter, IsAProjection) {
  const auto once = sub_cell_filter(make_level_set<2>(lattice_of(2), one_hole));
  EXPECT_LT(largest_difference(sub_cell_filter(once).values, once.values), 1e-15);
  const auto linear = make_level_set<2>(lattice_of(1), one_hole);
  EXPECT_EQ(sub_cell_filter(linear).values, linear.values);
}

TEST(Evolution, IsIndependentOfTheStartOfTheSector) {
  const auto lattice = lattice_of(2);
  const Evolver<2> evolver(lattice, {{ExtensionKind::h1, 2}, 0.25, {{0.01, 1}, {0.01, 1}}, {}});
  const int n_cells = 7;
  const auto evolved = [&](const LevelSet<2>& psi, const std::vector<SurfaceSample<2>>& gradient) {
    const auto velocity = *evolver.measure_preserving_velocity(gradient);
    const auto moved = *evolver.move(psi, velocity, 0.5 * lattice.grid().resolution());
    return *evolver.smooth(*evolver.redistance(moved));
  };
  const auto psi = distorted(make_level_set<2>(lattice, std::vector<Circle>{{0.265, 0.15, 0.035}}));
  const auto gradient = some_gradient(psi);
  auto turned_gradient = gradient;
  for (auto& sample : turned_gradient) {
    auto cell = lattice.grid().cell_position(sample.cell);
    cell[1] = (cell[1] + n_cells) % lattice.grid().cells[1];
    sample.cell = lattice.grid().cell_index(cell);
  }
  const LevelSet<2> turned_psi{lattice, turned(lattice, psi.values, 2 * n_cells)};
  const auto one = turned(lattice, evolved(psi, gradient).values, 2 * n_cells);
  const auto other = evolved(turned_psi, turned_gradient).values;
  EXPECT_LT(largest_difference(one, other), 1e-13);
}

}  // namespace
