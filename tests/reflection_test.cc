#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/mechanics/state/strain_peaks.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/tread_contact.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// With load positions between the columns too: 24 columns, 7 positions.
RollingModel<2> model_with(int n_positions) {
  RollingModel<2> model = testing::paper_model(14, 192);
  model.n_positions = n_positions;
  model.contact.friction = 0.3;
  return model;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values)
    if (std::isfinite(v)) result = std::max(result, std::abs(v));
  return result;
}

void expect_equal(const RingField& a, const RingField& b, double tolerance) {
  ASSERT_EQ(a.components, b.components);
  ASSERT_EQ(a.values.size(), b.values.size());
  const double scale = largest(b.values);
  double worst = 0;
  for (size_t i = 0; i < a.values.size(); ++i) {
    ASSERT_EQ(std::isnan(a.values[i]), std::isnan(b.values[i])) << i;
    if (!std::isnan(b.values[i])) worst = std::max(worst, std::abs(a.values[i] - b.values[i]));
  }
  EXPECT_LT(worst, tolerance * scale);
}

std::vector<PositionFields<2>> all_position_fields(const StateSolver<2>& solver, const State<2>& state) {
  std::vector<PositionFields<2>> all;
  for_each_position<2>(solver, state,
                       [&](int, PositionFields<2> fields) { all.push_back(std::move(fields)); });
  return all;
}

/// Points in contact, which both zones hold; beyond them zones may end one column apart.
std::vector<ContactPoint> touching(const std::vector<ContactPoint>& points, int position) {
  std::vector<ContactPoint> result;
  for (const auto& p : points)
    if (p.position == position && p.pressure > 0) result.push_back(p);
  return result;
}

/// How far reflected fields and contact points may be from solved ones, relative to their largest value.
struct Tolerances {
  double displacement, stress, contact;
};

/// The place of the peak may be that of its mirror image where the position is its own.
void expect_same_peak_and_rim(const PositionFields<2>& a, const PositionFields<2>& b, bool is_own_image,
                              const Tolerances& tolerances) {
  EXPECT_NEAR(a.von_mises.value, b.von_mises.value, 10 * tolerances.stress * b.von_mises.value);
  const Vec<2> ground{std::cos(b.ground_azimuth), std::sin(b.ground_azimuth)};
  const auto towards = [&](const Vec<2>& x) { return x[0] * ground[0] + x[1] * ground[1]; };
  const auto along = [&](const Vec<2>& x) { return x[1] * ground[0] - x[0] * ground[1]; };
  EXPECT_NEAR(towards(a.von_mises.place), towards(b.von_mises.place), 1e-9);
  const double sign = is_own_image && along(a.von_mises.place) * along(b.von_mises.place) < 0 ? -1 : 1;
  EXPECT_NEAR(sign * along(a.von_mises.place), along(b.von_mises.place), 1e-9);
  const double force = b.rim_force.towards_ground, travel = b.rim.towards_ground;
  EXPECT_NEAR(a.rim.towards_ground, travel, tolerances.contact * travel);
  EXPECT_NEAR(a.rim_force.towards_ground, force, tolerances.contact * force);
  EXPECT_NEAR(a.rim_force.along_ground, b.rim_force.along_ground, tolerances.contact * force);
  EXPECT_NEAR(a.rim_force.torque, b.rim_force.torque, tolerances.contact * force);
}

/// The points in contact: zones may end one column apart, and the image's line begins a sector later.
void expect_same_tread(TreadContact<2> a, TreadContact<2> b, const Tolerances& tolerances) {
  double peak = 0, size = 0, length_a = 0, length_b = 0;
  for (const TreadContactPoint<2>& p : a) length_a += p.weight;
  for (const TreadContactPoint<2>& p : b) {
    length_b += p.weight;
    peak = std::max(peak, p.pressure);
    size = std::max(size, std::hypot(p.displacement[0], p.displacement[1]));
  }
  EXPECT_NEAR(length_a, length_b, 1e-12);
  std::erase_if(a, [](const TreadContactPoint<2>& p) { return p.pressure == 0; });
  std::erase_if(b, [](const TreadContactPoint<2>& p) { return p.pressure == 0; });
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 3u);
  std::size_t first = 0;
  while (first < a.size() &&
         std::hypot(a[first].position[0] - b[0].position[0], a[first].position[1] - b[0].position[1]) > 1e-9)
    ++first;
  ASSERT_LT(first, a.size());
  for (std::size_t k = 0; k < b.size(); ++k) {
    const TreadContactPoint<2>&p = a[(first + k) % a.size()], &q = b[k];
    for (int d = 0; d < 2; ++d) {
      EXPECT_NEAR(p.position[d], q.position[d], 1e-12);
      EXPECT_NEAR(p.displacement[d], q.displacement[d], tolerances.displacement * size);
      EXPECT_NEAR(p.traction[d], q.traction[d], tolerances.contact * peak);
    }
    EXPECT_NEAR(p.pressure, q.pressure, tolerances.contact * peak);
    EXPECT_NEAR(p.friction, q.friction, tolerances.contact * peak);
    EXPECT_NEAR(p.gap, q.gap, tolerances.displacement * size);
    EXPECT_NEAR(p.weight, q.weight, 1e-15);
  }
}

void expect_what_solving_all_gives(int n, const std::vector<testing::Hole>& holes,
                                   const Tolerances& tolerances) {
  const auto problem = RollingProblem<2>::create(model_with(n));
  ASSERT_TRUE(problem);
  const LevelSet<2> psi = testing::holes(problem->model().grid, 2, holes);
  ASSERT_TRUE(is_mirror_symmetric(psi));
  const auto all = problem->states(psi, problem->all_positions(), Interrupt()),
             distinct = problem->states(psi, problem->distinct_positions(psi), Interrupt());
  ASSERT_TRUE(all && distinct);
  ASSERT_EQ((*distinct)->positions().size(), n / 2 + 1);
  ASSERT_EQ((*all)->positions().size(), n);

  const auto expected = all_position_fields(*problem, **all),
             found = all_position_fields(*problem, **distinct);
  ASSERT_EQ(found.size(), size_t(n));
  const auto expected_points = contact_points(*problem, **all), points = contact_points(*problem, **distinct);
  const auto expected_treads = all_tread_contacts(*problem, **all),
             treads = all_tread_contacts(*problem, **distinct);
  for (int i = 0; i < n; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(found[i].ground_azimuth, (*all)->positions().grounds[i].azimuth(problem->model().grid));
    expect_equal(found[i].displacement, expected[i].displacement, tolerances.displacement);
    expect_equal(found[i].stress, expected[i].stress, tolerances.stress);
    const bool is_own_image = holes.empty() || std::abs(std::sin(16 * expected[i].ground_azimuth)) < 1e-9;
    expect_same_peak_and_rim(found[i], expected[i], is_own_image, tolerances);
    expect_same_tread(treads[i], expected_treads[i], tolerances);
    const auto alone = position_fields(*problem, **distinct, i);
    EXPECT_EQ(alone.ground_azimuth, found[i].ground_azimuth);
    expect_equal(alone.displacement, expected[i].displacement, tolerances.displacement);
    expect_equal(alone.stress, expected[i].stress, tolerances.stress);
    const auto a = touching(points, i), b = touching(expected_points, i);
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GT(a.size(), 3u);
    double peak = 0;
    for (const auto& p : b) peak = std::max(peak, p.pressure);
    for (size_t k = 0; k < a.size(); ++k) {
      EXPECT_NEAR(a[k].x, b[k].x, 1e-12);
      EXPECT_NEAR(a[k].azimuth, b[k].azimuth, 1e-12);
      EXPECT_NEAR(a[k].pressure, b[k].pressure, tolerances.contact * peak);
      EXPECT_NEAR(a[k].normal_stress, b[k].normal_stress, tolerances.contact * peak);
      EXPECT_NEAR(a[k].friction, b[k].friction, tolerances.contact * peak);
      EXPECT_NEAR(a[k].weight, b[k].weight, 1e-15);
      EXPECT_NEAR(a[k].gap, b[k].gap, 1e-12);
    }
  }
}

class Reflection : public ::testing::TestWithParam<int> {};

// Fields come from their modes, which leave out 1e-10 of them; pressures are as exact as Newton's method
// leaves them.
TEST_P(Reflection, GivesWhatSolvingAllPositionsGives) {
  expect_what_solving_all_gives(
      GetParam(), {},
      {.displacement = 10 * mode_tolerance, .stress = 1000 * mode_tolerance, .contact = 2e-11});
}

// The quadrature of a cut cell is that of its image to 1e-7 only, and so are the solutions.
TEST_P(Reflection, GivesItOnAWheelWithHolesToTheirQuadrature) {
  const double middle = std::numbers::pi / 16;
  expect_what_solving_all_gives(GetParam(), {{0.26, middle, 0.025}, {0.295, middle, 0.012}},
                                {.displacement = 1e-5, .stress = 1e-4, .contact = 1e-9});
}

INSTANTIATE_TEST_SUITE_P(Positions, Reflection, ::testing::Values(1, 2, 6, 7));

TEST(WheelWithoutSymmetry, HasNoReflectedPositions) {
  const auto problem = RollingProblem<2>::create(model_with(4));
  ASSERT_TRUE(problem);
  const double sector = problem->model().grid.sector_angle();
  const LevelSet<2> psi = testing::holes(problem->model().grid, 2, {{0.26, 0.4 * sector, 0.02}});
  const auto states = problem->states(psi, problem->distinct_positions(psi), Interrupt());
  ASSERT_TRUE(states);
  for (const PositionSource& source : position_sources((*states)->positions(), 4))
    EXPECT_FALSE(source.is_image);
  const auto fields = all_position_fields(*problem, **states);
  ASSERT_EQ(fields.size(), 4u);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(fields[i].displacement.values[5], (*states)->displacement().at_nodes(i).values[5]);
  // The images would be others.
  const RingField image = mirror_image<2>(fields[1].lattice, fields[1].displacement);
  double difference = 0;
  for (size_t i = 0; i < image.values.size(); ++i)
    if (std::isfinite(image.values[i]) && std::isfinite(fields[3].displacement.values[i]))
      difference = std::max(difference, std::abs(image.values[i] - fields[3].displacement.values[i]));
  EXPECT_GT(difference, 1e-3 * largest(image.values));
}

TEST(MirrorImage, OfAFieldIsItsOwnInverseAndTurnsVectors) {
  const Lattice<2> lattice({0.20, 0.34, 0.12, 5, {2, 3}}, 2);
  RingField field{2, {}};
  for (int i = 0; i < 2 * lattice.n_nodes() * 5; ++i) field.values.push_back(std::sin(1.7 * i));
  const RingField image = mirror_image<2>(lattice, field);
  const RingField twice = mirror_image<2>(lattice, image);
  for (size_t i = 0; i < field.values.size(); ++i) EXPECT_NEAR(twice.values[i], field.values[i], 1e-15);
  // Position itself is a field whose image is itself.
  RingField position{2, std::vector<double>(field.values.size())};
  for (int line = 0; line < lattice.nodes()[1] * 5; ++line)
    for (int row = 0; row < lattice.nodes()[0]; ++row) {
      const double radius = 0.20 + row * 0.14 / 4,
                   azimuth = 2 * std::numbers::pi * line / (lattice.nodes()[1] * 5);
      double* x = &position.values[2 * ring_node<2>(lattice, {row, line})];
      x[0] = radius * std::cos(azimuth);
      x[1] = radius * std::sin(azimuth);
    }
  const RingField mirrored = mirror_image<2>(lattice, position);
  for (size_t i = 0; i < position.values.size(); ++i)
    EXPECT_NEAR(mirrored.values[i], position.values[i], 1e-15);
}

}  // namespace
}  // namespace wheelwright
