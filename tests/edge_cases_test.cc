#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/read.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/run/study/predicted_deformation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

/// A case of tests/edge_cases as `analyze` computes it.
struct Analyzed {
  Case source;
  std::shared_ptr<const StateSolver<2>> solver;
  LevelSet<2> shape;
  std::shared_ptr<const State<2>> state;
  RollingAnalysis analysis;
};

CaseResult read(const std::string& name) {
  return read_case(WHEELWRIGHT_SOURCE_DIR "/tests/edge_cases/" + name + ".toml");
}

Analyzed analyzed(const Case& c) {
  const auto solver = make_solver(rolling_model<2>(with_levels_of_results(c)));
  EXPECT_TRUE(solver);
  LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
  if (!state) throw std::runtime_error(state.failure().detail);
  return {c, *solver, std::move(shape), *state, rolling_analysis(**solver, **state)};
}

Analyzed analyzed(const std::string& name) { return analyzed(*read(name).value); }

void expect_refused(const std::string& name, const std::string& key) {
  const CaseResult result = read(name);
  ASSERT_FALSE(result.value) << name;
  EXPECT_TRUE(std::ranges::any_of(result.problems, [&](const Diagnostic& d) { return d.key == key; }))
      << result.problems.front().text();
}

/// The key by which a file of tests/edge_cases is refused; empty: its wheel can be solved.
const std::map<std::string, std::string> refused_key{{"base", ""},
                                                     {"bike_spokes", "holes.circle[15].radius"},
                                                     {"camber_low_friction", ""},
                                                     {"driven", ""},
                                                     {"friction_corner", ""},
                                                     {"light", ""},
                                                     {"light2", "load.mass"},
                                                     {"narrow_stick", ""},
                                                     {"nu4999_degree1", "grid.degree"},
                                                     {"overload", "load.mass"},
                                                     {"scooter_tpu", ""},
                                                     {"soft", ""},
                                                     {"speed_stiffness", ""},
                                                     {"speed_tiny_travel", "load.speed"},
                                                     {"steel", ""},
                                                     {"steel16", ""},
                                                     {"tram", ""},
                                                     {"wide_contact_friction_1", ""},
                                                     {"wide_contact_friction_2", "load.force"}};

template <int dim>
void expect_balanced(const Case& c, int max_steps) {
  const auto solver = make_solver(rolling_model<dim>(with_levels_of_results(c)));
  const auto state = (*solver)->states(initial_shape<dim>(c), (*solver)->all_positions(), Interrupt());
  ASSERT_TRUE(state) << state.failure().detail;
  const ContactPatch<dim>& contact = (*state)->contacts().front();
  double force = 0;
  for (const auto& point : contact.points) force -= point.weight * point.traction[0];
  const double load = (*solver)->model().load;
  EXPECT_NEAR(force, load, 1e-9 * load);
  EXPECT_LE(contact.newton_iterations, max_steps);
}

TEST(EdgeCases, EveryFileIsSolvedOrRefusedByTheRightKey) {
  for (const auto& entry : std::filesystem::directory_iterator(WHEELWRIGHT_SOURCE_DIR "/tests/edge_cases")) {
    const std::string name = entry.path().stem();
    SCOPED_TRACE(name);
    const std::string key = refused_key.at(name);
    if (!key.empty()) {
      expect_refused(name, key);
      continue;
    }
    Case c = *read(name).value;
    c.load.positions = 1;
    // Rounding decides where the path goes at the corner: 41 to 592 steps were seen on several processors.
    const int max_steps = name == "friction_corner" ? 2000 : 120;
    in_dimension_of(c, [&](auto dim) { expect_balanced<dim>(c, max_steps); });
  }
}

// `check` says before a solve what `run` and `analyze` say after it.
TEST(EdgeCases, LargeDeformationIsPredictedWhereItIsFound) {
  for (const std::string name : {"base", "scooter_tpu", "tram"}) {
    SCOPED_TRACE(name);
    Case c = *read(name).value;
    c.load.positions = 2;
    const auto warned = [&] {
      const Analyzed a = analyzed(c);
      return !deformation_warning(deformation_size(*a.solver, a.shape, *a.state)).empty();
    };
    EXPECT_EQ(prediction_warning(predicted_deformations(c)).has_value(), warned());
    c.load.force *= 10;
    EXPECT_EQ(prediction_warning(predicted_deformations(c)).has_value(), warned());
  }
}

TEST(EdgeCases, CrushedHolesAreANamedFailure) {
  Case c = *read("base").value;
  c.load.travel = 0.07;
  const auto solver = make_solver(rolling_model<2>(c));
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
  ASSERT_TRUE(state) << state.failure().detail;
  const auto overlap = material_overlaps(**solver, shape, **state);
  ASSERT_TRUE(overlap);
  EXPECT_EQ(overlap->reason, FailureReason::material_overlaps);
  const auto made = make_study<2>(c);
  const auto evaluated = evaluate_of(*made)(shape, nullptr);
  ASSERT_FALSE(evaluated);
  EXPECT_EQ(evaluated.failure().reason, FailureReason::material_overlaps);
}

TEST(EdgeCases, RimBelowTheGroundIsANamedFailure) {
  Case c = *read("base").value;
  c.material.youngs_modulus = 2e4;
  c.load.force = 600;
  c.holes.rings.front().radius = 0.055;
  c.wheel.inner_radius = 0.15;
  c.holes.rings.front().center_radius = 0.245;
  const auto solver = make_solver(rolling_model<2>(c));
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
  ASSERT_FALSE(state);
  EXPECT_EQ(state.failure().reason, FailureReason::rim_under_ground);
  EXPECT_TRUE(prediction_warning(predicted_deformations(c)));
}

// Linear elasticity without friction: a light load deforms less, and the nearer to the ground the more of it.
TEST(EdgeCases, LightLoadsAndStiffMaterialsAreSolved) {
  for (const std::string name : {"light", "steel", "steel16"}) {
    SCOPED_TRACE(name);
    const Analyzed a = analyzed(name);
    for (const ContactSummary& position : a.analysis.positions) {
      EXPECT_NEAR(position.radial_force, load_per_metre(a.source), 1e-9 * load_per_metre(a.source));
      EXPECT_GT(position.travel, 0);
    }
    const auto [minimum, maximum] = std::ranges::minmax(*a.analysis.travel_at_load);
    EXPECT_LT(maximum, 3 * minimum);
  }
}

// Under a thousandth of the load, a wheel travels about a thousandth, but for the logarithm of the patch.
TEST(EdgeCases, TravelIsNearlyProportionalToTheLoad) {
  Case c = *read("base").value;
  c.load.positions = 2;
  const double heavy = analyzed(c).analysis.positions[0].travel;
  c.load.force /= 1000;
  const double light = analyzed(c).analysis.positions[0].travel;
  EXPECT_GT(light, heavy / 1000);
  EXPECT_LT(light, 2 * heavy / 1000);
}

TEST(EdgeCases, LargeDeformationIsReported) {
  const Analyzed scooter = analyzed("scooter_tpu");
  const DeformationSize size = deformation_size(*scooter.solver, scooter.shape, *scooter.state);
  EXPECT_GT(size.strain, small_strain);
  EXPECT_NE(deformation_warning(size), "");
  EXPECT_LT(share_of_small_load(size), 1);
  const Analyzed tram = analyzed("tram");
  EXPECT_EQ(deformation_warning(deformation_size(*tram.solver, tram.shape, *tram.state)), "");
}

TEST(EdgeCases, TheNamedShareOfALargeLoadDeformsLittle) {
  const auto size_of = [](const Analyzed& a) { return deformation_size(*a.solver, a.shape, *a.state); };
  Case c = *read("scooter_tpu").value;
  const double share = share_of_small_load(size_of(analyzed(c)));
  c.load.force *= share;
  const DeformationSize size = size_of(analyzed(c));
  EXPECT_NEAR(std::max(size.strain / small_strain, size.travel / small_travel), 1, 0.1);
}

// A path of contact problems that stays at a corner of the contact law, where rounding decides where it goes,
// is left soon.
TEST(EdgeCases, StagnatingPathIsAbandoned) {
  // Which of these gets to the corner depends on rounding, and so on the build and the processor.
  for (const int positions : {1, 2, 4}) {
    Case c = *read("friction_corner").value;
    c.load.positions = positions;
    const auto solver = make_solver(rolling_model<2>(c));
    ASSERT_TRUE(solver);
    int steps = 0;
    const Interrupt interrupt([&] { return ++steps > 3000 * positions; }, [](const ContactProgress&) {});
    const auto state = (*solver)->states(initial_shape<2>(c), (*solver)->all_positions(), interrupt);
    ASSERT_TRUE(state) << positions << ": " << state.failure().detail;
  }
}

// Where the last point that sticks begins to slide, nothing resists a motion of the rim along the ground.
TEST(EdgeCases, PathsPassPiecesWhoseTangentIsSingular) {
  const Case c = *read("narrow_stick").value;
  const auto solver = make_solver(rolling_model<2>(c));
  ASSERT_TRUE(solver);
  const auto state = (*solver)->states(initial_shape<2>(c), (*solver)->all_positions(), Interrupt());
  ASSERT_TRUE(state) << state.failure().detail;
  const RollingModel<2>& model = (*solver)->model();
  for (const auto& contact : (*state)->contacts()) {
    Vec<2> force{};
    for (const auto& point : contact.points)
      for (int d = 0; d < 2; ++d) force[d] += point.weight * point.traction[d];
    EXPECT_NEAR(force[0], -model.load, 1e-9 * model.load);
    EXPECT_NEAR(force[1], -model.horizontal_force, 1e-9 * model.load);
  }
}

TEST(EdgeCases, WideContactWithFrictionReportsProgressAndStops) {
  Case c = *read("wide_contact_friction_1").value;
  c.load.positions = 2;
  const auto solver = make_solver(rolling_model<2>(c));
  std::vector<ContactProgress> told;
  int steps_after_the_stop = -1;
  std::clock_t stopped = 0;
  const auto asks = [&] {
    const bool stop = told.size() >= 10;
    if (stop && ++steps_after_the_stop == 0) stopped = std::clock();
    return stop;
  };
  const Interrupt interrupt(asks, [&](const ContactProgress& progress) { told.push_back(progress); });
  const auto state = (*solver)->states(initial_shape<2>(c), (*solver)->all_positions(), interrupt);
  const double seconds = double(std::clock() - stopped) / CLOCKS_PER_SEC;
  ASSERT_FALSE(state);
  EXPECT_EQ(state.failure().reason, FailureReason::interrupted);
  ASSERT_EQ(told.size(), 10);
  EXPECT_LT(seconds, 2);
  for (size_t k = 0; k < told.size(); ++k) {
    EXPECT_EQ(told[k].position, 0);
    EXPECT_EQ(told[k].n_positions, 2);
    if (k > 0) {
      EXPECT_LE(told[k].newton_steps, told[k - 1].newton_steps + 1);
    }
  }
}

/// A solid roller of 5 cm on a rigid plane, with a rim of 1 mm and no key of the grid set.
Case solid_roller(double force) {
  const std::string text =
      "[wheel]\ninner_radius = 0.001\nouter_radius = 0.05\nwidth = 1\nsectors = 8\n"
      "[material]\nyoungs_modulus = 52.5e9\npoissons_ratio = 0.3\n[load]\nforce = " +
      std::to_string(force) + "\n";
  return *parse_case(text, "roller.toml").value;
}

TEST(EdgeCases, TheSolidRollerIsResolvedWithoutAnyKeyOfTheGrid) {
  for (const ContactSummary& position : analyzed(solid_roller(35e6)).analysis.positions) {
    EXPECT_NEAR(position.peak_pressure, 3612e6, 0.003 * 3612e6);
    EXPECT_NEAR(position.patch_length, 12.32e-3, 0.003 * 12.32e-3);
  }
  const Case light = solid_roller(35e4);
  for (const ContactSummary& position : analyzed(light).analysis.positions) {
    EXPECT_NEAR(position.peak_pressure, hertz_peak_pressure(light), 0.01 * hertz_peak_pressure(light));
    EXPECT_NEAR(position.patch_length, 2 * hertz_half_width(light), 0.02 * hertz_half_width(light));
  }
}

const std::string curved_spokes = R"(
[wheel]
sectors = 24
[material]
youngs_modulus = 200e6
poissons_ratio = 0.4
[[shape.annulus]]
[[shape.spoke]]
kind = "curved"
count = 24
thickness = 0.010
angle = 12
bend = 40
[grid]
radial_cells = 28
angular_cells = 480
)";

/// The tread between two spokes lifts off the ground: at some positions it touches in two places.
TEST(EdgeCases, APatchWithAGapIsAsLongAsThePointsThatTouch) {
  const CaseResult result = parse_case(curved_spokes, "spokes.toml");
  ASSERT_TRUE(result.value) << result.problems.front().text();
  const Analyzed a = analyzed(*result.value);
  int with_gap = 0;
  for (size_t i = 0; i < a.analysis.positions.size(); ++i) {
    double touching = 0, first = HUGE_VAL, last = -HUGE_VAL;  // what the points in contact stand for
    for (const auto& point : a.state->contacts()[i].points) {
      if (point.traction[0] >= 0) continue;
      touching += point.weight;
      first = std::min(first, point.position[1] - 0.5 * point.weight);
      last = std::max(last, point.position[1] + 0.5 * point.weight);
    }
    const double cells = 1.5e-3;  // two of them, one at each end
    const ContactSummary& found = a.analysis.positions[i];
    EXPECT_NEAR(found.patch_length, touching, cells) << i;
    EXPECT_NEAR(found.patch_extent, last - first, cells) << i;
    if (last - first > touching + 5 * cells) ++with_gap;
  }
  EXPECT_GT(with_gap, 0);
  EXPECT_LT(with_gap, 8);
}

}  // namespace
}  // namespace wheelwright
