#include "wheelwright/shape/evolution/widths.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/deformations.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/shape/evolution/deformation_space.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

template <int dim>
Lattice<dim> lattice_of() {
  if constexpr (dim == 2)
    return {{0.20, 0.34, 0.12, 12, {28, 32}}, 2};
  else
    return {{0.20, 0.34, 0.12, 12, {24, 28, 6}}, 2};
}

/// Two holes with a wall of this many cells between them along the radius, and one that crosses the face of
/// the sector; in 3D the wall is narrowest at one place of the width.
template <int dim>
LevelSet<dim> shape_with_wall(double cells, double azimuth = 0.13) {
  const auto lattice = lattice_of<dim>();
  const double h = lattice.grid().resolution(), wall = cells * h;
  auto psi = make_level_set<dim>(
      lattice, std::vector<Circle>{
                   {0.235, azimuth, 0.018}, {0.235 + 0.036 + wall, azimuth, 0.018}, {0.262, 0.42, 0.03}});
  if constexpr (dim == 3)
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const double off = lattice.polar_point(node)[2] / lattice.grid().width - 0.45;
      psi.values[node] -= 8 * h * off * off;
    }
  return spline_level_set(spline_coefficients(psi));
}

constexpr double directions[] = {0.0, 0.35, 0.7, 1.05, 1.4};

/// Two round holes with a wall between them, at this angle to the radius.
LevelSet<2> oblique_wall(double wall, double direction) {
  const double radius = 0.018, distance = 2 * radius + wall;
  const Vec<2> second{0.25 + distance * std::cos(direction), distance * std::sin(direction)};
  return spline_level_set(spline_coefficients(make_level_set<2>(
      lattice_of<2>(), std::vector<Circle>{{0.25, 0.1, radius},
                                           {norm(second), 0.1 + std::atan2(second[1], second[0]), radius}})));
}

/// A hole that is a square with this half of the side and corners of this radius, turned; in 3D it becomes
/// narrower along the width.
template <int dim>
LevelSet<dim> shape_with_corners(double half, double radius) {
  const auto lattice = lattice_of<dim>();
  LevelSet<dim> psi{lattice, {}};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.polar_point(node);
    const double x = p[0] - 0.272, y = 0.272 * (p[1] - 0.25), cosine = std::cos(0.4), sine = std::sin(0.4);
    const double u = std::max(std::abs(cosine * x + sine * y) - half + radius, 0.0),
                 v = std::max(std::abs(cosine * y - sine * x) - half + radius, 0.0);
    const double inside = std::min(
        std::max(std::abs(cosine * x + sine * y), std::abs(cosine * y - sine * x)) - half + radius, 0.0);
    psi.values.push_back(radius - std::hypot(u, v) - inside - (dim == 3 ? 0.05 * (p[dim - 1] - 0.03) : 0));
  }
  return spline_level_set(spline_coefficients(psi));
}

template <class Setting>
class WidthsOf : public ::testing::Test {};
TYPED_TEST_SUITE(WidthsOf, wheelwright::testing::DeformationSettings);

}  // namespace

/// Taylor's test with respect to the deformation: the narrowest wall changes as its derivative says, to
/// second order, also where it is as thin as a cell and psi has a kink in its middle.
TYPED_TEST(WidthsOf, ChangeAsTheirDerivativeSays) {
  constexpr int dim = TypeParam::dim;
  const auto lattice = lattice_of<dim>();
  const double h = lattice.grid().resolution();
  const DeformationSpace<dim> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                    TypeParam::kind);
  const auto deformation = wheelwright::testing::smooth_deformation<dim>(lattice, space.n_components());
  for (const double cells : {2.0, 1.0}) {
    const auto psi = shape_with_wall<dim>(cells);
    const FeatureSize size{.wall = 1.8 * cells * h};
    const auto widths = narrow_widths(psi, size, 0);
    ASSERT_FALSE(widths.empty());
    EXPECT_NEAR(widths[0].value, cells * h, 0.4 * h);  // splines round what is as thin as a cell
    const auto load = gap_load(space.motion_of(psi, {}), widths[0]);
    const double slope = std::inner_product(load.begin(), load.end(), deformation.begin(), 0.0);
    const auto speeds = space.speeds(psi, deformation);
    double last = 0;
    for (const double step : {4e-2, 2e-2, 1e-2}) {
      const double time = step * h / largest_magnitude(speeds);
      const auto moved = spline_level_set(smooth_transport<dim>(spline_coefficients(psi), speeds, time));
      const auto after = narrow_widths(moved, size, 0);
      ASSERT_FALSE(after.empty());
      const double remainder = std::abs(after[0].gap() - widths[0].gap() - time * slope);
      EXPECT_LT(remainder, 0.1 * std::abs(time * slope));
      if (last > 0) {
        EXPECT_GT(std::log2(last / remainder), 1.9) << cells << " cells, " << step;
      }
      last = remainder;
    }
  }
}

/// The same of the radius of an internal corner: that of a hole with the outline of a rounded square, turned.
TYPED_TEST(WidthsOf, RadiiOfCornersChangeAsTheirDerivativeSays) {
  constexpr int dim = TypeParam::dim;
  const auto lattice = lattice_of<dim>();
  const double h = lattice.grid().resolution();
  const DeformationSpace<dim> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                    TypeParam::kind);
  const auto deformation = wheelwright::testing::smooth_deformation<dim>(lattice, space.n_components());
  const auto psi = shape_with_corners<dim>(6 * h, 2.5 * h);
  const FeatureSize size{.radius = 3 * h};
  const auto widths = narrow_widths(psi, size, 0);
  ASSERT_FALSE(widths.empty());
  ASSERT_EQ(widths[0].kind, WidthKind::corner);
  const auto speeds = space.speeds(psi, deformation);
  const double unit = h / largest_magnitude(speeds);
  const auto coefficients = spline_coefficients(psi);
  const auto load = gap_load(space.motion_of(psi, {}), widths[0]);
  const double slope = unit * std::inner_product(load.begin(), load.end(), deformation.begin(), 0.0);
  double last = 0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    const auto moved = smooth_transport<dim>(coefficients, speeds, step * unit);
    const double after = largest_gap(narrow_widths(spline_level_set(moved), size, 0)),
                 remainder = std::abs(after - widths[0].gap() - step * slope);
    if (last > 0) {
      EXPECT_GT(std::log2(last / remainder), 1.9);
    }
    last = remainder;
  }
  EXPECT_LT(last, 0.05 * std::abs(1e-3 * slope));
}

/// A wall, and a gap, are found where they are narrower than the minimum width plus the reach, at their
/// place.
TEST(Widths, AreThoseWithinReach) {
  const auto lattice = lattice_of<2>();
  const double h = lattice.grid().resolution();
  const auto psi = shape_with_wall<2>(2);
  auto holes = psi;
  for (double& value : holes.values) value = -value;
  const double width = narrow_widths(psi, {.wall = 3 * h}, 0)[0].value;
  for (const bool is_wall : {true, false}) {
    const auto& shape = is_wall ? psi : holes;
    const auto size_of = [&](double minimum) {
      return is_wall ? FeatureSize{.wall = minimum} : FeatureSize{.gap = minimum};
    };
    EXPECT_TRUE(narrow_widths(shape, size_of(0.97 * width), 0).empty());
    EXPECT_FALSE(narrow_widths(shape, size_of(0.97 * width), 0.05 * width).empty());
    const auto widths = narrow_widths(shape, size_of(1.02 * width), 0);
    ASSERT_EQ(widths.size(), 1u);
    EXPECT_EQ(widths[0].kind, is_wall ? WidthKind::wall : WidthKind::gap);
    EXPECT_NEAR(widths[0].gap(), 1 - 1 / 1.02, 1e-9);
    EXPECT_NEAR(widths[0].place[0], 0.235 + 0.018 + h, 0.1 * h);
    EXPECT_NEAR(widths[0].place[1], 0.13, 0.01);
    EXPECT_DOUBLE_EQ(largest_gap(widths), widths[0].gap());
  }
}

/// Walls between round holes, in several directions to the grid, are widened until the level set itself,
/// which is what is analyzed and cut, has the minimum: its edges may lie hundredths of a cell inside those of
/// the cubic interpolant. Measured on the curves that are fitted to the edges.
TEST(Widths, AreThoseOfTheLevelSetItself) {
  const auto lattice = lattice_of<2>();
  const double h = lattice.grid().resolution();
  const Evolver<2> evolver(lattice, {.velocity = {},
                                     .bands = {},
                                     .space = ShapeSpace::spline,
                                     .deformation = DeformationKind::normal_speed});
  int n_widened = 0;
  for (const double cells : {1.1, 1.3, 1.7})
    for (const double direction : directions) {
      const double minimum = cells * h;
      const auto psi = oblique_wall(0.8 * minimum, direction);
      const auto made = evolver.measured(psi, {.wall = minimum});
      ASSERT_TRUE(made) << made.failure().detail;
      const double before = outline_measures(psi)->clearances.wall->width,
                   after = outline_measures(made->shape)->clearances.wall->width;
      EXPECT_GT(after, 0.995 * minimum) << cells << " cells, " << direction;
      EXPECT_LT(after, 1.03 * std::max(minimum, before)) << cells << " cells, " << direction;
      n_widened += before < 0.98 * minimum;
    }
  EXPECT_GE(n_widened, 8);
}

/// Walls of the level set are narrower than those of its interpolant by as much as gaps of the opposite
/// shape.
TEST(Widths, AreNarrowerByAsMuchInTheOppositeShape) {
  const double h = lattice_of<2>().grid().resolution();
  double largest = 0;
  for (const double cells : {1.1, 1.3, 1.7})
    for (const double direction : directions) {
      const auto psi = oblique_wall(cells * h, direction);
      auto opposite = psi;
      for (double& value : opposite.values) value = -value;
      const double width = 1.4 * cells * h;
      const auto walls = narrow_widths(psi, {.wall = width}, 0),
                 gaps = narrow_widths(opposite, {.gap = width}, 0);
      ASSERT_FALSE(walls.empty());
      ASSERT_EQ(walls.size(), gaps.size());
      for (std::size_t k = 0; k < walls.size(); ++k) {
        EXPECT_NEAR(walls[k].narrower, gaps[k].narrower, 1e-9 * h);
        largest = std::max(largest, walls[k].narrower / h);
      }
    }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(largest, 0.1);
}

/// The round ends of slots that are as wide as twice their radius lack nothing.
TEST(Widths, RoundEndsOfSlotsAreNotNarrower) {
  const auto lattice = lattice_of<2>();
  const double h = lattice.grid().resolution(), radius = 1.1 * h;
  LevelSet<2> psi{lattice, {}};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.polar_point(node);
    const double x = p[0] - 0.27, y = 0.27 * (p[1] - 0.25);
    psi.values.push_back(radius - std::hypot(std::max(std::abs(x) - 0.03, 0.0), y));
  }
  const auto widths = narrow_widths(psi, {.gap = 2 * radius}, 0.3 * h);
  ASSERT_FALSE(widths.empty());
  for (const auto& width : widths) EXPECT_LT(width.narrower, 0.1 * h) << width.place[0];
}

/// If only a corner is far too sharp, it is rounded, and a wall that hardly lacks anything gets its width but
/// not more.
TEST(Widths, RoundingACornerHardlyThickensWalls) {
  const auto lattice = lattice_of<2>();
  const double h = lattice.grid().resolution();
  const FeatureSize size{.wall = 1.42 * h, .gap = 0, .radius = 0.75 * h};
  auto psi = make_level_set<2>(
      lattice, std::vector<Circle>{{0.235, 0.1, 0.018}, {0.235 + 0.036 + 1.2 * h, 0.1, 0.018}});
  const auto corners = shape_with_corners<2>(0.012, 0);
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::max(psi.values[node], corners.values[node]);
  psi = spline_level_set(spline_coefficients(psi));
  const auto widest_gap = [&](const LevelSet<2>& shape, WidthKind kind) {
    double gap = -1;
    for (const auto& width : narrow_widths(shape, size, 0.5 * h))
      if (width.kind == kind) gap = std::max(gap, width.gap());
    return gap;
  };
  ASSERT_GT(widest_gap(psi, WidthKind::corner), 0.2);
  ASSERT_GT(widest_gap(psi, WidthKind::wall), 0.001);
  ASSERT_LT(widest_gap(psi, WidthKind::wall), 0.1);
  const Evolver<2> evolver(lattice, {.velocity = {},
                                     .bands = {},
                                     .space = ShapeSpace::spline,
                                     .deformation = DeformationKind::normal_speed});
  const auto made = evolver.measured(psi, size);
  ASSERT_TRUE(made) << made.failure().detail;
  EXPECT_LE(widest_gap(made->shape, WidthKind::corner), 1e-3);
  EXPECT_NEAR(widest_gap(made->shape, WidthKind::wall), 0, 5e-3);
}

/// The widths of a mirror-symmetric shape are symmetric as a set, so that what is derived from them is.
TEST(Widths, OfASymmetricShapeAreSymmetric) {
  const auto lattice = lattice_of<2>();
  const double h = lattice.grid().resolution(), angle = lattice.grid().sector_angle();
  const auto psi = mirror_symmetric_part(make_level_set<2>(
      lattice,
      std::vector<Circle>{{0.235, 0.3 * angle, 0.018}, {0.235, 0.7 * angle, 0.018}, {0.285, 0, 0.03}}));
  ASSERT_TRUE(is_mirror_symmetric(psi));
  const auto widths = narrow_widths(psi, {.wall = 8 * h, .gap = 12 * h}, 0);
  ASSERT_FALSE(widths.empty());
  for (const auto& width : widths)
    EXPECT_TRUE(std::ranges::any_of(widths,
                                    [&](const auto& other) {
                                      return std::abs(other.place[0] - width.place[0]) < 1e-9 &&
                                             std::abs(std::remainder(other.place[1] + width.place[1],
                                                                     angle)) < 1e-9 &&
                                             std::abs(other.value - width.value) < 1e-12;
                                    }))
        << width.place[0] << " " << width.place[1];
}
