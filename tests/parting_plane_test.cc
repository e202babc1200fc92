#include <cmath>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/run/study/parting_planes.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/evolution/islands.h"

// The parting plane of a moulded wheel, found from the first wheels of all planes.

namespace wheelwright::testing {
namespace {

std::string caster(const std::string& load, const std::string& optimizer) {
  return "[wheel]\ndimension = 3\ninner_radius = 0.025\nouter_radius = 0.0625\nwidth = 0.032\nsectors = 12\n"
         "[material]\nyoungs_modulus = 60e6\npoissons_ratio = 0.3\n[load]\nmass = 25\npositions = 1\n" +
         load +
         "[contact]\nquadrature_points = 3\n[[shape.slot]]\ncount = 12\ncenter_radius = 0.042\n"
         "length = 0.020\nwidth = 0.011\n[grid]\nradial_cells = 9\nangular_cells = 96\naxial_cells = 2\n"
         "degree = 1\ntread_levels = 0\n[output]\nerrors = \"none\"\n[volume]\ntarget = 0.7\n[optimizer]\n"
         "iterations = 2\nmade = \"moulded\"\nrim_band = 0.0043\ntread_band = 0.0086\n" +
         optimizer;
}

Case read(const std::string& text) {
  CaseResult result = parse_case(text, "case.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

TEST(PartingPlane, OfNearTiesIsTheNearestToTheMiddle) {
  const auto best = [](const std::vector<double>& objectives) {
    std::vector<RatedPlane> planes;
    for (std::size_t i = 0; i < objectives.size(); ++i)
      planes.push_back({0.01 * double(i), objectives[i], ""});
    return best_plane(planes, 0.01 * double(objectives.size() - 1));
  };
  EXPECT_EQ(best({1, 1, 1, 1, 1}), 2u);
  EXPECT_EQ(best({1, 2, 3, 2, 1}), 0u);  // both are as far from the middle
  EXPECT_EQ(best({1, 2, 1 + 1e-5, 2, 1}), 0u);
  EXPECT_EQ(best({1, 2, 1 + 1e-7, 2, 1}), 2u);
  EXPECT_EQ(best({3, 2, std::nan(""), 1, 2}), 3u);
  EXPECT_FALSE(best({std::nan(""), std::nan("")}));
}

// Without lean, planes that are mirror images of each other have the same objective; with it they do not.
TEST(PartingPlane, OfALeaningWheelIsOnTheSideThatCarriesTheLoad) {
  const std::string found = "draft = 4\nparting = \"found\"\n";
  const auto upright = rated_parting_planes(read(caster("", found)));
  ASSERT_TRUE(upright) << upright.failure().detail;
  ASSERT_EQ(upright->planes.size(), 3u);
  EXPECT_NEAR(upright->volume, 0.7, 1e-12);
  EXPECT_NEAR(upright->planes[0].objective / upright->planes[2].objective, 1, 1e-4);
  const auto leaning = rated_parting_planes(read(caster("camber = 4\n", found)));
  ASSERT_TRUE(leaning) << leaning.failure().detail;
  EXPECT_LT(leaning->planes[2].objective, 0.97 * leaning->planes[0].objective);
  EXPECT_GT(leaning->best, 0u);
}

// Holes that are the same along the axle come out of any mould without draft: the middle is as good as any.
TEST(PartingPlane, OfHolesThatFitAllMouldsIsTheMiddle) {
  const Case c = read(caster("camber = 4\n", "parting = \"found\"\n"));
  const auto rated = rated_parting_planes(c);
  ASSERT_TRUE(rated) << rated.failure().detail;
  for (const RatedPlane& plane : rated->planes)
    EXPECT_NEAR(plane.objective / rated->planes[0].objective, 1, 1e-7);
  EXPECT_EQ(rated->best, 1u);
  const auto complete = with_parting_plane_found(c);
  ASSERT_TRUE(complete);
  EXPECT_EQ(complete->optimizer.parting, Parting::given);
  EXPECT_NEAR(*complete->optimizer.parting_plane, 0.016, 1e-15);
}

// A groove from which a mould that parts at 90 mm would cut the tread off, unless it is made shallower: at
// the target's volume that wheel is the stiffest, but a run begins with the groove as it is drawn.
TEST(PartingPlane, IsOneWithWhichARunCanBegin) {
  const Case c = read(R"(
[wheel]
dimension = 3
sectors = 16
[load]
mass = 300
positions = 1
camber = 3
[contact]
quadrature_points = 3
[material]
poissons_ratio = 0.4
[[holes.groove]]
inner_radius = 0.222
outer_radius = 0.31
depth = 0.033
[volume]
target = 0.7
[grid]
radial_cells = 10
angular_cells = 128
axial_cells = 4
degree = 1
tread_levels = 0
[optimizer]
made = "moulded"
parting = "found"
draft = 2
rim_band = 0.014
tread_band = 0.028
)");
  const auto rated = rated_parting_planes(c);
  ASSERT_TRUE(rated) << rated.failure().detail;
  for (const RatedPlane& plane : rated->planes) {
    const auto attached =
        without_islands<3>(initial_shape<3>(with_parting_plane(c, plane.z)), 1e-3);  // m^3: of any size
    EXPECT_EQ(plane.fault.empty(), bool(attached)) << plane.z;
  }
  EXPECT_NEAR(rated->planes[rated->best].z, 0.06, 1e-12);
}

TEST(PartingPlane, IsFoundOnlyInAMouldWithAnObjectiveThatDiffers) {
  const auto problem = [](const std::string& text) {
    const CaseResult result = parse_case(text, "case.toml");
    return result.value ? std::string() : result.problems.front().problem;
  };
  const std::string found = "parting = \"found\"\n";
  EXPECT_EQ(problem(caster("", found)), "");
  EXPECT_EQ(problem(caster("", found + "parting_plane = 0.016\n")),
            "the parting plane is given and to be found");
  EXPECT_EQ(problem("[wheel]\ndimension = 3\n[optimizer]\n" + found), "the wheel is not moulded");
  std::string mass = caster("", found);
  mass.replace(mass.find("poissons_ratio"), 0, "density = 1000\n");
  mass.erase(mass.find("[volume]"), std::string("[volume]\ntarget = 0.7\n").size());
  mass += "[objective]\nminimize = \"mass\"\n[[constraint]]\nquantity = \"stiffness\"\nat_least = 1e5\n";
  EXPECT_EQ(problem(mass), "the planes are compared at the same volume, where all wheels weigh the same");
}

class FoundPlane : public TemporaryFolder {};

// The run's case has the plane as a number, and the run is that of the number.
TEST_F(FoundPlane, IsThatOfTheRunsCase) {
  const auto run = [&](const Case& c, const std::string& name) {
    std::vector<std::string> told;
    auto begun = wheelwright::Run<3>::begin(
        c, folder() / name, PlaneSearch{.report = [&](const std::string& line) { told.push_back(line); }});
    EXPECT_TRUE(begun);
    if (begun) {
      CommandQueue commands;
      begun->execute(commands);
    }
    return told;
  };
  const Case found = read(caster("camber = 4\n", "draft = 4\nparting = \"found\"\n"));
  EXPECT_EQ(run(found, "found").size(), 5u);  // of three planes, and what is done and chosen
  const Case stored = read(content(folder() / "found" / "case.toml"));
  EXPECT_EQ(stored.optimizer.parting, Parting::given);
  ASSERT_TRUE(stored.optimizer.parting_plane);
  Case given = found;
  given.optimizer.parting = Parting::given;
  given.optimizer.parting_plane = stored.optimizer.parting_plane;
  EXPECT_TRUE(run(given, "given").empty());
  expect_equal_results(folder() / "given", folder() / "found");
}

}  // namespace
}  // namespace wheelwright::testing
