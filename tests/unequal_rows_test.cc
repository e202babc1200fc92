// Grids whose rows move to given radii: their geometry, and that shapes move across lines where rows of
// unequal height meet as they do elsewhere.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wheelwright/files/level_set_file.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/cubic_interpolant.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/multilinear.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/geometry/annulus.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/moved_lines.h"
#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/geometry/values_on.h"
#include "wheelwright/shape/geometry/zero_contour.h"

using namespace wheelwright;

namespace {

using std::numbers::pi;

/// 11 rows of 5.6 mm, 6 of 3 mm, 11 of 5.5 mm.
const PolarGrid<2> unequal{0.20, 0.34, 0.12, 16, {28, 24}, {{11, 0.262}, {17, 0.280}}};

/// Across both lines, off all nodes and planes of symmetry.
const std::vector<Circle> hole{{0.2713, 0.171, 0.0317}};

double distance_from_hole(const Vec<2>& polar) { return signed_distance<2>(unequal, hole, polar); }

/// The largest distance of the zero line from a circle.
double zero_line_error(const LevelSet<2>& psi, const Circle& circle) {
  double error = 0;
  for (const auto& seed : zero_seeds<2>(CubicInterpolant<2>(psi)))
    error = std::max(
        error, std::abs(signed_distance<2>(psi.lattice.grid(), {&circle, 1}, psi.lattice.polar_of(seed))));
  return error;
}

/// The observed order of errors on grids that halve their cells.
template <class Error>
void expect_order(double order, Error error, int levels = 3) {
  double last = 0;
  for (int level = 0; level < levels; ++level) {
    const double found = error(divided(unequal, 1 << level));
    if (level > 0) {
      EXPECT_GT(std::log2(last / found), order) << level << ": " << last << " " << found;
    }
    last = found;
  }
}

}  // namespace

TEST(UnequalRows, HaveTheRadiiOfTheirLines) {
  EXPECT_EQ(unequal.radius(11), 0.262);
  EXPECT_EQ(unequal.radius(17), 0.280);
  EXPECT_NEAR(unequal.radius(28), 0.34, 1e-15);
  EXPECT_NEAR(unequal.radius(14), 0.271, 1e-15);
  EXPECT_NEAR(unequal.row_height(10), 0.062 / 11, 1e-15);
  EXPECT_NEAR(unequal.row_height(11), 0.003, 1e-15);
  EXPECT_NEAR(unequal.height_of_rows(9, 19), unequal.radius(19) - unequal.radius(9), 1e-15);
  EXPECT_NEAR(unequal.resolution(), 0.003, 1e-15);
  const Lattice<2> lattice(unequal, 2);
  for (double line = -0.5; line < 28.6; line += 0.25) {
    EXPECT_NEAR(unequal.line_at(unequal.radius(line)), line, 1e-12);
    EXPECT_NEAR(lattice.place_at(lattice.radius(2 * line)), 2 * line, 1e-12);
    EXPECT_NEAR(lattice.radius(2 * line), unequal.radius(line), 1e-15);
  }
  EXPECT_NEAR(lattice.radial_distance(20, 25), 0.062 / 11 + 0.0045, 1e-15);
}

TEST(MovedLines, LieAtTheirRadiiAndLeaveRowsSimilar) {
  const PolarGrid<2> equal{0.20, 0.34, 0.12, 16, {28, 24}};
  EXPECT_EQ(with_lines_at(equal, {0.22, 0.29}), equal);
  EXPECT_EQ(with_lines_at(equal, {}), equal);
  const auto moved = with_lines_at(equal, {0.2623, 0.2807, 0.3391});
  ASSERT_EQ(moved.fixed_lines.size(), 3u);
  EXPECT_EQ(moved.fixed_lines[1].radius, 0.2807);
  EXPECT_EQ(moved.cells, equal.cells);
  const auto rows = moved.all_equal_rows();
  EXPECT_EQ(rows[0].count(), 12);
  EXPECT_EQ(rows[1].count(), 4);
  EXPECT_EQ(rows[2].count(), 11);
  EXPECT_EQ(rows[3].count(), 1);
  EXPECT_NEAR(largest_row_ratio(moved).ratio, (0.0584 / 11) / 0.0009, 1e-9);
  EXPECT_EQ(largest_row_ratio(moved).radius, 0.3391);
  // Two radii near the same line of equal rows.
  EXPECT_EQ(with_lines_at(equal, {0.22, 0.22 + 1e-9}).fixed_lines.size(), 2u);
  const auto finer = divided(moved, 3);
  for (int line = 0; line <= 28; ++line) EXPECT_NEAR(finer.radius(3 * line), moved.radius(line), 1e-15);
}

TEST(UnequalRows, LetTheCubicInterpolantHaveFourthOrder) {
  expect_order(3.7, [](const PolarGrid<2>& grid) {
    const Lattice<2> lattice(grid, 2);
    LevelSet<2> psi{lattice, {}};
    const auto f = [](const Vec<2>& x) { return std::sin(60 * x[0]) * std::cos(16 * x[1]); };
    for (int node = 0; node < lattice.n_nodes(); ++node) psi.values.push_back(f(lattice.polar_point(node)));
    const CubicInterpolant<2> interpolant(psi);
    double error = 0;
    for (int k = 0; k < 200; ++k) {
      const Vec<2> place{lattice.place_at(0.25 + 0.04 * k / 200), 0.1231 / lattice.node_angle()};
      const Vec<2> x = lattice.polar_of(place);
      error = std::max(error, std::abs(interpolant(place).value - f(x)));
      EXPECT_NEAR(interpolant(place).gradient[0], 60 * std::cos(60 * x[0]) * std::cos(16 * x[1]), 2.0);
    }
    return error;
  });
}

/// The same orders as on equal rows (Redistancing, Transport).
TEST(UnequalRows, LetTheDistanceBeExact) {
  expect_order(2.8, [](const PolarGrid<2>& grid) {
    LevelSet<2> psi = make_level_set<2>(Lattice<2>(grid, 2), hole);
    for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
      const Vec<2> x = psi.lattice.polar_point(node);
      psi.values[node] *= 1 + 0.5 * std::sin(60 * x[0]) * std::cos(32 * x[1]);
    }
    const auto redistanced = redistance<2>(psi);
    double error = 0;
    for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
      const double exact = distance_from_hole(psi.lattice.polar_point(node));
      if (std::abs(exact) < 0.01) error = std::max(error, std::abs(redistanced.values[node] - exact));
    }
    return error;
  });
}

TEST(UnequalRows, LetACircleMoveWithSecondOrder) {
  for (const double sign : {1.0, -1.0}) {
    constexpr double time = 0.007;
    Circle moved = hole.front();
    moved.hole_radius -= sign * time;
    expect_order(1.8, [&](const PolarGrid<2>& grid) {
      LevelSet<2> psi = make_level_set<2>(Lattice<2>(grid, 2), hole);
      for (double& value : psi.values) value *= sign;
      return zero_line_error(transport<2>(psi, std::vector<double>(psi.values.size(), 1.0), time), moved);
    });
  }
}

TEST(UnequalRows, MeasureAHoleExactly) {
  const double area = pi * std::pow(hole.front().hole_radius, 2),
               perimeter = 2 * pi * hole.front().hole_radius;
  expect_order(2.8, [&](const PolarGrid<2>& grid) {
    return std::abs(sector_measure<2>(grid) - material_measure(make_level_set<2>(Lattice<2>(grid, 2), hole)) -
                    area);
  });
  const LevelSet<2> psi = make_level_set<2>(Lattice<2>(unequal, 2), hole);
  double length = 0;
  for (const auto& sample : boundary_samples<2>(psi)) length += sample.weight;
  EXPECT_NEAR(length / perimeter, 1, 1e-5);
  const auto found = components(psi);
  double whole = 0;
  for (const auto& component : found.all) {
    whole += component.measure;
    if (component.is_material) continue;
    EXPECT_NEAR(component.measure / area, 1, 0.03);
    // The mean radius of a disc is larger than that of its centre.
    const double a = hole.front().hole_radius, centre = hole.front().centre_radius;
    EXPECT_NEAR(component.centre[0], centre + a * a / (8 * centre), 1e-4);
    EXPECT_NEAR(component.outermost[0], hole.front().centre_radius + hole.front().hole_radius, 2e-3);
  }
  EXPECT_NEAR(whole / sector_measure<2>(unequal), 1, 1e-5);
  double contours = 0;
  for (const auto& contour : material_contours(psi, 4)) contours += signed_area(contour);
  EXPECT_NEAR(contours / (16 * (sector_measure<2>(unequal) - area)), 1, 2e-4);
  const ZeroContour zero(psi);
  for (double angle = 0.1; angle < 6; angle += 0.3) {
    const Vec<2> centre = cartesian<2>({hole.front().centre_radius, hole.front().centre_azimuth});
    const double r = hole.front().hole_radius + 0.001;
    const auto x = zero.projection({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)});
    ASSERT_TRUE(x);
    EXPECT_NEAR(distance(*x, centre), hole.front().hole_radius, 2e-6);
  }
}

TEST(UnequalRows, IntegrateAreaAndLinearFunctions) {
  const Lattice<2> lattice(unequal, 2);
  std::vector<double> ones(lattice.n_nodes(), 1.0), radius;
  for (int node = 0; node < lattice.n_nodes(); ++node) radius.push_back(lattice.polar_point(node)[0]);
  const auto energy = [&](double mass, double stiffness, const std::vector<double>& v) {
    const auto product = symmetric_product(multilinear_form<2>(lattice, mass, stiffness), v);
    double sum = 0;
    for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] * product[k];
    return sum;
  };
  const double area = sector_measure<2>(unequal);
  EXPECT_NEAR(energy(1, 0, ones) / area, 1, 1e-12);
  EXPECT_NEAR(energy(0, 1, radius) / area, 1, 1e-12);
}

/// On grids that divide every row, and from them.
TEST(UnequalRows, PassShapesToOtherGrids) {
  const LevelSet<2> psi = make_level_set<2>(Lattice<2>(unequal, 2), hole);
  const Lattice<2> finer(divided(unequal, 2), 2);
  const LevelSet<2> fine = values_on(psi, finer), back = values_on(fine, psi.lattice);
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    EXPECT_NEAR(back.values[node], psi.values[node], 1e-14);
  EXPECT_NEAR(material_measure(fine) / material_measure(psi), 1, 1e-7);
  PolarGrid<2> equal = unequal;
  equal.fixed_lines.clear();
  EXPECT_FALSE(have_same_nodes(psi.lattice, Lattice<2>(equal, 2)));
  const LevelSet<2> on_equal = values_on(psi, Lattice<2>(equal, 2));
  for (int node = 0; node < on_equal.lattice.n_nodes(); ++node) {
    const double exact = distance_from_hole(on_equal.lattice.polar_point(node));
    if (std::abs(exact) < 0.01) {
      EXPECT_NEAR(on_equal.values[node], exact, 1e-5);
    }
  }
}

TEST(UnequalRows, ConsistOfParts) {
  const LevelSet<2> psi = make_level_set<2>(Lattice<2>(unequal, 2), hole);
  double sum = 0;
  for (const auto& [first, end] : {std::pair{0, 5}, {5, 17}, {17, 28}}) {
    const LevelSet<2> part = in_rows(psi, first, end);
    EXPECT_NEAR(part.lattice.grid().inner_radius, unequal.radius(first), 1e-15);
    EXPECT_NEAR(part.lattice.grid().radius(3), unequal.radius(first + 3), 1e-15);
    sum += material_measure(part);
  }
  EXPECT_NEAR(sum / material_measure(psi), 1, 1e-12);
}

TEST(UnequalRows, AreKeptInFiles) {
  const LevelSet<2> psi = make_level_set<2>(Lattice<2>(unequal, 2), hole);
  const auto read = parse_level_set_file<2>(level_set_file(psi));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->lattice.grid(), unequal);
  EXPECT_EQ(read->values, psi.values);
  for (const std::vector<FixedLine>& lines : {std::vector<FixedLine>{{17, 0.262}, {11, 0.28}},
                                              {{11, 0.28}, {17, 0.262}},
                                              {{28, 0.3}},
                                              {{3, 0.35}}}) {
    PolarGrid<2> wrong = unequal;
    wrong.fixed_lines = lines;
    EXPECT_FALSE(parse_level_set_file<2>(level_set_file(LevelSet<2>{Lattice<2>(wrong, 2), psi.values})));
  }
}
