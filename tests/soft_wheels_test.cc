#include "tests/soft_wheels.h"

#include <gtest/gtest.h>

#include <ctime>
#include <iostream>
#include <map>
#include <numbers>
#include <regex>
#include <string>

#include "wheelwright/base/parallel.h"
#include "wheelwright/case/presets.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"
#include "wheelwright/mechanics/state/material_edges.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

using testing::SoftWheels;

/// Whether a wheel may end so: what gives way is the wheel, not the method.
bool is_physics(FailureReason reason) {
  switch (reason) {
    case FailureReason::not_positive_definite:  // it buckles
    case FailureReason::overload:               // its load has a maximum
    case FailureReason::material_overlaps:
    case FailureReason::rim_under_ground:
    case FailureReason::sliding:
      return true;
    default:
      return false;
  }
}

std::string unbalanced(const State<2>& state) {
  const RollingModel<2>& model = state.model();
  for (const auto& contact : state.contacts()) {
    double force = 0;
    for (const auto& point : contact.points) force -= point.weight * point.ground_traction()[0];
    const double wanted = model.travel ? contact.rim_force.towards_ground : model.load;
    if (!(std::abs(force - wanted) <= 1e-8 * wanted))
      return "the contact carries " + std::to_string(force / wanted);
    if (!(force > 0)) return "the ground pulls";
  }
  return "";
}

struct End {
  std::string kind;  ///< "solved", "refused" or the reason of the failure
  std::string complaint;
  double travel = 0;  ///< by the ring's thickness
};

End end_of(const Case& drawn) {
  const CaseResult read = parse_case(to_toml(drawn), "soft.toml");
  if (!read.value) return {"refused", read.problems.front().text()};
  const auto solver = make_solver(rolling_model<2>(*read.value));
  if (!solver) return {"refused", solver.failure().detail};
  const LevelSet<2> shape = initial_shape<2>(*read.value);
  const auto states = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
  const auto failed = [](const Failure& failure) {
    return End{to_string(failure.reason), is_physics(failure.reason) ? "" : failure.detail};
  };
  if (!states) return failed(states.failure());
  if (const auto failure = material_overlaps(**solver, shape, **states)) return failed(*failure);
  const PolarGrid<2>& grid = (*solver)->model().grid;
  return {"solved", unbalanced(**states),
          (*states)->contacts().front().travel() / (grid.outer_radius - grid.inner_radius)};
}

/// Every wheel is solved and balanced, or ends with a reason that is its own.
void expect_an_end_of_each(int n, unsigned seed) {
  const ThreadLimit one_thread(1);
  SoftWheels wheels(seed);
  std::map<std::string, int> count;
  double longest = 0, least = 1, most = 0;
  for (int k = 0; k < n; ++k) {
    const Case c = wheels.draw();
    const std::clock_t begin = std::clock();
    const End end = end_of(c);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    longest = std::max(longest, seconds);
    ++count[end.kind];
    if (end.kind == "solved") {
      least = std::min(least, end.travel);
      most = std::max(most, end.travel);
    }
    EXPECT_LT(seconds, 60) << "wheel " << k;
    if (!end.complaint.empty())
      ADD_FAILURE() << "wheel " << k << ", " << end.kind << ": " << end.complaint << "\n" << to_toml(c);
  }
  for (const auto& [kind, number] : count) std::cout << number << " " << kind << ", ";
  std::cout << "travels from " << 100 * least << " to " << 100 * most << " % of the ring; at most " << longest
            << " s each\n";
  EXPECT_GE(count["solved"], 0.75 * n);
}

/// The preset with soft spokes on a coarse grid.
Case coarse_soft_spokes() {
  Case c = *parse_case(find_preset("soft-spokes")->text, "preset.toml").value;
  c.grid.radial_cells = 14;
  c.grid.angular_cells = 160;
  c.optimizer.rim_band = c.optimizer.tread_band = 0.0129;
  return c;
}

/// The solution of the load position at azimuth 0.
auto over_a_spoke(const LargeDeformationProblem<2>& problem, const LevelSet<2>& shape) {
  return problem.solve({shape, nullptr}, {{{0}}, {1}});
}

/// A wheel whose spokes bow out carries no more than a certain load: that is found by the rim's travel, from
/// any larger load, and is the largest force at a held travel.
TEST(SoftWheels, TheLargestLoadIsFoundByTheTravel) {
  Case c = coarse_soft_spokes();
  constexpr double degree = std::numbers::pi / 180;
  SpokeShape& spoke = c.shapes.spokes.front();
  spoke.thickness = 0.012;
  spoke.angle = 4 * degree;
  spoke.bend = 6 * degree;
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto solve = [&](const Case& loaded) {
    const RollingModel<2> model = rolling_model<2>(loaded);
    return over_a_spoke(*LargeDeformationProblem<2>::create(model), shape);
  };
  const auto force_at = [&](double travel) {
    Case held = c;
    held.load.travel = travel;
    const auto solved = solve(held);
    return solved ? solved->equilibria.front().state.rim_force.towards_ground : 0.0;
  };
  c.load.force = 9000;
  const auto failed = solve(c);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.failure().reason, FailureReason::overload) << failed.failure().detail;
  std::smatch match;
  ASSERT_TRUE(std::regex_search(failed.failure().detail, match,
                                std::regex("at most about ([0-9.e+]+) N/m .* travel of ([0-9.]+) m")))
      << failed.failure().detail;
  const double travel = std::stod(match[2]), largest = force_at(travel);
  EXPECT_NEAR(std::stod(match[1]) / largest, 1, 1e-3);
  EXPECT_LT(force_at(0.9 * travel), largest);
  EXPECT_LT(force_at(1.1 * travel), largest);
}

/// A curve of travels has the forces of wheels solved from rest up to the travel at which edges of
/// neighbouring spokes cross, and says so beyond; loads beyond one that fails are not sought.
TEST(SoftWheels, ACurveEndsWhereEdgesCross) {
  const Case c = coarse_soft_spokes();
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto at_travel = [&](double travel) {
    Case held = c;
    held.load.travel = travel;
    return rolling_model<2>(held);
  };
  const auto problem = *LargeDeformationProblem<2>::create(at_travel(0.004));
  const auto solution = over_a_spoke(problem, shape);
  ASSERT_TRUE(solution) << solution.failure().detail;
  std::vector<RollingModel<2>> models;
  for (const double travel : {0.008, 0.016, 0.022, 0.028}) models.push_back(at_travel(travel));
  const auto curve = problem.curve(*solution, 0, models);
  const MaterialEdges<2> edges(shape, {models[0].grid, models[0].degree});
  int n_open = 0;
  for (size_t k = 0; k < models.size(); ++k) {
    const auto afresh = over_a_spoke(*LargeDeformationProblem<2>::create(models[k]), shape);
    if (!afresh) continue;
    const auto& equilibrium = afresh->equilibria.front();
    if (edges.overlap(nodal_displacement(*afresh->ring, equilibrium))) {
      ASSERT_FALSE(curve[k]);
      EXPECT_EQ(curve[k].failure().reason, FailureReason::material_overlaps) << curve[k].failure().detail;
      continue;
    }
    ++n_open;
    ASSERT_TRUE(curve[k]) << curve[k].failure().detail;
    EXPECT_NEAR(
        curve[k]->equilibrium.state.rim_force.towards_ground / equilibrium.state.rim_force.towards_ground, 1,
        1e-7);
  }
  EXPECT_GE(n_open, 2);
  EXPECT_FALSE(curve.back());
}

/// A flat slot over the ground closes under its load: the curve says at about which load, and at which
/// places.
TEST(SoftWheels, ACurveSaysTheLoadAtWhichASlotCloses) {
  Case c = coarse_soft_spokes();
  constexpr double middle = 0.175, width = 0.005;
  c.shapes = {};
  c.material.youngs_modulus = 8e6;
  c.material.poissons_ratio = 0.45;
  c.grid.radial_cells = 28;
  c.grid.angular_cells = 240;
  c.shapes.slots.push_back({.count = 12,
                            .center_radius = middle,
                            .length = 0.06,
                            .width = width,
                            .angle = std::numbers::pi / 2,
                            .phase = 0});
  c.wheel.sectors = 12;
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto under = [&](double load) {
    Case loaded = c;
    loaded.load.force = load;
    return rolling_model<2>(loaded);
  };
  const auto problem = *LargeDeformationProblem<2>::create(under(700));
  const auto solution = over_a_spoke(problem, shape);
  ASSERT_TRUE(solution) << solution.failure().detail;
  const std::vector<RollingModel<2>> models{under(1000), under(2000)};
  const auto curve = problem.curve(*solution, 0, models);
  ASSERT_TRUE(curve[0]) << curve[0].failure().detail;
  ASSERT_FALSE(curve[1]);
  const Failure& failure = curve[1].failure();
  ASSERT_EQ(failure.reason, FailureReason::material_overlaps) << failure.detail;
  ASSERT_TRUE(failure.largest_load);
  const double largest = *failure.largest_load;
  const MaterialEdges<2> edges(shape, {models[0].grid, models[0].degree});
  const auto closes_under = [&](double load) {
    const auto afresh = over_a_spoke(*LargeDeformationProblem<2>::create(under(load * c.wheel.width)), shape);
    return edges.overlap(nodal_displacement(*afresh->ring, afresh->equilibria.front()));
  };
  EXPECT_FALSE(closes_under(0.9 * largest));
  EXPECT_TRUE(closes_under(1.1 * largest));
  std::smatch radii;
  ASSERT_TRUE(std::regex_search(failure.detail, radii,
                                std::regex("at radius ([0-9.]+) mm.* at radius ([0-9.]+) mm")));
  EXPECT_NEAR(std::abs(std::stod(radii[1]) - std::stod(radii[2])) / 1000 / width, 1, 0.3) << failure.detail;
  EXPECT_NEAR((std::stod(radii[1]) + std::stod(radii[2])) / 2000, middle, 0.3 * width);
}

/// Steps of a curve may be large: what Newton's method does not reach from the load before is sought
/// otherwise.
TEST(SoftWheels, ACurveTakesLargeSteps) {
  Case c = coarse_soft_spokes();
  const LevelSet<2> shape = initial_shape<2>(c);
  c.load.force = 200;
  const auto problem = *LargeDeformationProblem<2>::create(rolling_model<2>(c));
  c.load.force = 2400;
  const std::vector models{rolling_model<2>(c)};
  const auto solution = over_a_spoke(problem, shape),
             afresh = over_a_spoke(*LargeDeformationProblem<2>::create(models[0]), shape);
  ASSERT_TRUE(solution && afresh);
  const auto curve = problem.curve(*solution, 0, models);
  ASSERT_TRUE(curve[0]) << curve[0].failure().detail;
  EXPECT_NEAR(
      curve[0]->equilibrium.state.rim.towards_ground / afresh->equilibria.front().state.rim.towards_ground, 1,
      1e-7);
}

TEST(SoftWheels, AreSolvedOrEndWithAReason) { expect_an_end_of_each(8, 1); }
TEST(SoftWheels, AreSolvedOrEndWithAReasonSlow) { expect_an_end_of_each(200, 2); }

}  // namespace
}  // namespace wheelwright
