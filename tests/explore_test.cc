#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <set>
#include <thread>

#include "tests/run_support.h"
#include "wheelwright/app/number_list.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/set_number.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/design/explore/exploration.h"
#include "wheelwright/design/explore/finalists.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/design/explore/sweep.h"
#include "wheelwright/design/explore/workers.h"
#include "wheelwright/design/starts/draft.h"
#include "wheelwright/design/starts/random.h"
#include "wheelwright/design/starts/solid_draft.h"
#include "wheelwright/design/starts/start.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/checkpoints/folder_lock.h"
#include "wheelwright/run/checkpoints/lock_reach.h"
#include "wheelwright/run/study/problem_size.h"
#include "wheelwright/run/study/study.h"

// Many designs of one case: how they are drawn, run, and ranked.

namespace wheelwright::testing {
namespace {

Case case_of(const std::string& text) {
  CaseResult result = parse_case(text, "test.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

const std::string usual_wheel = R"(
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 28
angular_cells = 256
)";

TEST(Random, IsUniformAndTheSameEverywhere) {
  Random random(7, 3), same(7, 3), other(7, 4);
  double sum = 0, squares = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform(0, 1);
    EXPECT_EQ(x, same.uniform(0, 1));
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0.5, 0.01);
  EXPECT_NEAR(squares / n, 1. / 3, 0.01);
  EXPECT_NE(other.uniform(0, 1), Random(7, 3).uniform(0, 1));
}

// At their inner ends neighbours are nearest.
TEST(Drafts, SlotsKeepTheirWallsUpToTheLargestSize) {
  const DraftSpace space{.inner = 0.21, .outer = 0.33, .wall = 0.006, .sectors = 1};
  Random random(4, 1);
  int n_drawn = 0;
  for (int k = 0; k < 300; ++k) {
    const auto draft = draft_slots(space, random);
    if (!draft) continue;
    Case c;
    draft->draw(c, draft->most);
    ASSERT_EQ(c.shapes.slots.size(), 1u);
    const SlotShape& slot = c.shapes.slots[0];
    if (slot.angle != 0) continue;
    const double foot = slot.center_radius - 0.5 * (slot.length - slot.width);
    EXPECT_GE(2 * foot * std::sin(std::numbers::pi / slot.count) - slot.width, space.wall * (1 - 1e-9)) << k;
    EXPECT_GE(slot.center_radius - 0.5 * slot.length, space.inner * (1 - 1e-9));
    EXPECT_LE(slot.center_radius + 0.5 * slot.length, space.outer * (1 + 1e-9));
    ++n_drawn;
  }
  EXPECT_GT(n_drawn, 100);
}

/// Starts of random seeds and volumes are valid cases of the volume asked for.
void expect_valid_starts(const Case& c, const StartRange& range, std::uint64_t seed, int n) {
  std::set<std::string> kinds;
  for (int number = 0; number < n; ++number) {
    const auto start = draw_start(c, range, seed, number).start;
    ASSERT_TRUE(start) << number << ", seed " << seed << ", volume " << range.volume;
    SCOPED_TRACE(start->text);
    const CaseResult again = parse_case(to_toml(start->source), "start.toml");
    ASSERT_TRUE(again.value);
    EXPECT_TRUE(lost_on_the_grid<2>(start->source).empty());
    EXPECT_NEAR(initial_volume(start->source), range.volume, 0.01);
    EXPECT_EQ(start->source.volume.target,
              holds_volume(c) ? std::optional(range.volume) : std::optional<double>());
    if (range.keeps_sectors) {
      EXPECT_EQ(start->source.wheel.sectors % c.wheel.sectors, 0);
    }
    kinds.insert(start->text.substr(start->text.find(' ') + 1));
    const auto same = draw_start(c, range, seed, number).start;
    EXPECT_EQ(same->source, start->source);
  }
  EXPECT_GT(kinds.size(), 4u);
}

TEST(Starts, AreValidAndOfTheVolume) { expect_valid_starts(case_of(usual_wheel), {0.66}, 1, 10); }

TEST(Starts, OfManySeedsAndVolumesAreValidSlow) {
  const Case c = case_of(usual_wheel);
  for (std::uint64_t seed = 2; seed < 12; ++seed)
    expect_valid_starts(c, {0.5 + 0.025 * double(seed), seed % 2 == 0}, seed, 20);
}

TEST(Starts, OfOtherRingsAreValid) {
  expect_valid_starts(case_of("[wheel]\ninner_radius = 0.05\nouter_radius = 0.1\nwidth = 0.03\nsectors = 6\n"
                              "[load]\nmass = 20\n[grid]\nradial_cells = 28\nangular_cells = 288\n"),
                      {0.7}, 5, 10);
}

const std::string solid_wheel =
    "[wheel]\ndimension = 3\n[contact]\nquadrature_points = 3\n" + usual_wheel + "axial_cells = 2\n";

TEST(Starts, OfAnExtrudedWheelAreThoseOfThePlane) {
  const Case plane = case_of(usual_wheel);
  Case solid = case_of(solid_wheel);
  solid.optimizer.made = Manufacture::extruded;
  EXPECT_EQ(kinds_of_starts(solid), kinds_of_starts(plane));
  for (int number = 0; number < 10; ++number) {
    const auto flat = draw_start(plane, {0.66}, 3, number).start,
               extruded = draw_start(solid, {0.66}, 3, number).start;
    ASSERT_TRUE(flat && extruded) << number;
    EXPECT_EQ(extruded->text, flat->text);
    EXPECT_EQ(extruded->source.holes, flat->source.holes) << flat->text;
    EXPECT_EQ(extruded->source.shapes, flat->source.shapes) << flat->text;
    EXPECT_NEAR(initial_volume(extruded->source), initial_volume(flat->source), 1e-5) << flat->text;
    EXPECT_EQ(extruded->source.wheel.dimension, 3);
  }
}

/// A coarse wheel in 3D, made in one of the ways.
Case coarse_solid(Manufacture made) {
  Case c = case_of(R"(
[wheel]
dimension = 3
[contact]
quadrature_points = 3
[grid]
radial_cells = 14
angular_cells = 144
axial_cells = 6
[volume]
target = 0.7
[optimizer]
rim_band = 0.0101
tread_band = 0.0201
[[holes.groove]]
inner_radius = 0.222
outer_radius = 0.318
depth = 0.033
)");
  c.optimizer.made = made;
  return c;
}

/// The starts of a case in 3D, all of which are valid, of the volume asked for, and not changed by fitting.
std::vector<Start> valid_solid_starts(const Case& c, std::uint64_t seed, int n) {
  std::vector<Start> result;
  for (int number = 0; number < n; ++number) {
    const auto start = draw_start(c, {0.7}, seed, number).start;
    if (!start) {
      ADD_FAILURE() << "none with number " << number;
      continue;
    }
    SCOPED_TRACE(start->text);
    EXPECT_TRUE(parse_case(to_toml(start->source), "start.toml").value);
    EXPECT_TRUE(lost_on_the_grid<3>(start->source).empty());
    EXPECT_NEAR(initial_volume(start->source), 0.7, 0.01);
    EXPECT_EQ(draw_start(c, {0.7}, seed, number).start->source, start->source);
    result.push_back(*start);
  }
  return result;
}

/// Heights of material and hole along lines parallel to the axle: calls line(values) for each of a few.
template <class Line>
void for_each_line(const Case& c, Line line) {
  const LevelSet<3> psi = initial_shape<3>(c);
  const int n = c.grid.axial_cells * psi.lattice.degree();
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto place = psi.lattice.node_position(node);
    if (place[2] != 0) continue;
    std::vector<double> values;
    for (place[2] = 0; place[2] <= n; ++place[2]) values.push_back(psi.values[psi.lattice.node_index(place)]);
    line(values);
  }
}

/// How often material begins along the values, from a hole.
int beginnings(const std::vector<double>& values) {
  int n = 0;
  for (std::size_t i = 0; i < values.size(); ++i) n += values[i] < 0 && (i == 0 || values[i - 1] >= 0);
  return n;
}

TEST(Starts, OfATurnedWheelAreBodiesOfRevolution) {
  const Case c = coarse_solid(Manufacture::turned);
  std::set<std::string> texts;
  for (const Start& start : valid_solid_starts(c, 1, 6)) {
    texts.insert(start.text);
    EXPECT_FALSE(start.source.holes.grooves.empty());
    Holes only_grooves;
    only_grooves.grooves = start.source.holes.grooves;
    EXPECT_EQ(start.source.holes, only_grooves) << start.text;
    EXPECT_EQ(start.source.shapes, Shapes{}) << start.text;
    EXPECT_EQ(start.source.grid.angular_cells, c.grid.angular_cells);
    EXPECT_EQ(start.source.wheel.sectors, c.wheel.sectors);
  }
  EXPECT_EQ(texts.size(), 6u);
}

TEST(Starts, SlowOfAFreeWheelIn3DAreOfAllKinds) {
  const Case c = coarse_solid(Manufacture::free);
  const std::vector<StartKind> kinds = kinds_of_starts(c);
  EXPECT_EQ(std::set<StartKind>(kinds.begin(), kinds.end()).size(), 14u);
  int discs = 0, tapered = 0, of_the_plane = 0;
  for (const Start& start : valid_solid_starts(c, 2, static_cast<int>(kinds.size()))) {
    discs += !start.source.holes.grooves.empty();
    tapered += !start.source.holes.tapered.empty();
    of_the_plane += start.source.holes.grooves.empty() && start.source.holes.tapered.empty();
  }
  EXPECT_GE(discs, 4);
  EXPECT_GE(tapered, 1);
  EXPECT_GE(of_the_plane, 9);
}

// Along every line parallel to the axle there is one piece of material at most, and it contains the plane.
TEST(Starts, SlowOfAMouldedWheelComeOutOfIt) {
  for (const double plane : {0., 0.04, 0.06}) {
    Case c = coarse_solid(Manufacture::moulded);
    c.optimizer.parting_plane = plane;
    c.optimizer.draft = 0.03;
    const int at = static_cast<int>(std::lround(plane / (c.wheel.width / c.grid.axial_cells)));
    for (const Start& start : valid_solid_starts(c, 3, 9))
      for_each_line(start.source, [&](const std::vector<double>& values) {
        EXPECT_LE(beginnings(values), 1) << start.text;
        const bool has_material = std::ranges::any_of(values, [](double x) { return x < -1e-9; });
        if (has_material) {
          EXPECT_LT(values[at * level_set_degree(c)], 1e-9) << start.text;
        }
      });
  }
}

TEST(Starts, SlowOfAPrintedWheelStandOnThePlate) {
  for (const SideFace plate : {SideFace::smaller_z, SideFace::larger_z}) {
    Case c = coarse_solid(Manufacture::printed);
    c.holes.grooves[0].side = plate == SideFace::smaller_z ? GrooveSide::larger_z : GrooveSide::smaller_z;
    c.optimizer.stands_on = plate;
    bool has_disc = false;
    for (const Start& start : valid_solid_starts(c, 4, 9))
      for (const HoleGroove& groove : start.source.holes.grooves) {
        EXPECT_EQ(groove.side, c.holes.grooves[0].side) << start.text;
        has_disc = true;
      }
    EXPECT_TRUE(has_disc);
  }
}

TEST(Drafts, DiscsKeepTheirWallUpToTheLargestSize) {
  const DraftSpace space{.inner = 0.21, .outer = 0.33, .wall = 0.006, .sectors = 1};
  Random random(4, 2);
  for (int k = 0; k < 400; ++k) {
    AxialSpace across{.width = 0.12, .wall = 0.02, .sectors = 16};
    if (k % 2 == 1) across.kept = random.uniform(0, 0.12);
    const auto draft = draft_disc(space, across, random, static_cast<DiscKind>(k / 2 % 4));
    if (!draft) continue;
    Case c;
    draft->draw(c, draft->most);
    for (const bool is_outer : {false, true}) {
      double low = 0, high = across.width;
      for (const HoleGroove& groove : c.holes.grooves) {
        const double depth = is_outer ? groove.outer_depth.value_or(groove.depth) : groove.depth;
        if (groove.side != GrooveSide::larger_z) low = depth;
        if (groove.side != GrooveSide::smaller_z) high = across.width - depth;
        EXPECT_GE(groove.inner_radius, space.inner);
        EXPECT_LE(groove.outer_radius, space.outer);
      }
      EXPECT_GE(high - low, across.wall * (1 - 1e-9)) << draft->text;
      if (across.kept) {
        EXPECT_GE(*across.kept - low, -1e-9) << draft->text;
        EXPECT_GE(high - *across.kept, -1e-9) << draft->text;
      }
    }
  }
}

TEST(Costs, ManyDesignsRunAtOnceOnlyIfTheirMemoryIsThere) {
  EXPECT_EQ(designs_at_once(12, 8, 1e9, {}), 8);
  EXPECT_EQ(designs_at_once(3, 8, 1e9, {}), 3);
  EXPECT_EQ(designs_at_once(12, 8, 1e9, 3.9e9), 3);
  EXPECT_EQ(designs_at_once(12, 8, 1e9, 0.5e9), 1);
  EXPECT_EQ(designs_at_once(12, 8, 1e9, 1e15), 8);
  EXPECT_EQ(limit_of_threads(8, 3), 6);  // three threads and the five that are left
  EXPECT_EQ(limit_of_threads(8, 1), 8);
  EXPECT_EQ(limit_of_threads(8, 8), 1);
}

TEST(Costs, AreThoseOfTheLargestDesignAndTheMeanTime) {
  Case small = case_of("[wheel]\ndimension = 3\n[contact]\nquadrature_points = 3\n" + usual_wheel);
  Case large = small;
  large.grid.axial_cells = 8;
  const Design one{"001", "", small, {}}, other{"002", "", large, {}};
  const DesignCosts costs = design_costs({one, other});
  EXPECT_EQ(costs.bytes, estimated_memory(problem_size(large)));
  EXPECT_GT(costs.bytes_on_finer_grid, costs.bytes);
  EXPECT_NEAR(
      *costs.seconds_per_shape,
      0.5 * (estimated_seconds_in_3d(problem_size(small)) + estimated_seconds_in_3d(problem_size(large))),
      1e-9);
  EXPECT_FALSE(design_costs({{"001", "", case_of(usual_wheel), {}}}).seconds_per_shape);
  small.grid.radial_cells = 4;
  small.grid.angular_cells = 64;
  EXPECT_TRUE(why_no_finalists({other}));
  EXPECT_FALSE(why_no_finalists({{"001", "", small, {}}, other}));
}

/// Each quantity has the word of designs and the name of case files.
TEST(RankedQuantities, AreFoundByTheirNamesInCaseFiles) {
  for (const auto& [word, name] :
       {std::pair("strain", "largest_strain"), std::pair("peak_stress", "peak_von_mises")}) {
    const RankedQuantity* found = find_quantity(name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found, find_quantity(word));
    EXPECT_EQ(found->word, word);
  }
  EXPECT_FALSE(find_quantity("largest_stress"));
}

TEST(RankedQuantities, HaveTheUnitsOfTheDimension) {
  Case c = case_of(usual_wheel);
  const auto energy = [&] {
    const auto all = ranked_quantities(c);
    return *std::ranges::find(all, "strain_energy", &RankedQuantity::word);
  };
  EXPECT_EQ(std::string(energy().shown.name), "J/m");
  c.wheel.dimension = 3;
  EXPECT_EQ(std::string(energy().shown.name), "J");
  EXPECT_EQ(energy().key, "strain_energy_J");
}

const std::string min_mass = R"(
[material]
density = 1100
[objective]
minimize = "mass"
[[constraint]]
quantity = "stiffness"
at_least = 40e6
)";

TEST(Starts, OfACaseWhoseVolumeIsFreeAreValid) {
  expect_valid_starts(case_of(usual_wheel + min_mass), {0.66}, 1, 10);
}

// What a turn costs depends on the number of load positions around the wheel, not in a sector.
TEST(Starts, OfLossyWheelsHaveAsManyLoadPositionsAroundThem) {
  Case c = case_of(usual_wheel);
  int n_changed = 0;
  for (int number = 2; number < 12; ++number) {
    c.material.loss_factor.reset();
    const auto elastic = draw_start(c, {0.66}, 1, number).start;
    c.material.loss_factor = 0.1;
    const auto lossy = draw_start(c, {0.66}, 1, number).start;
    ASSERT_EQ(elastic.has_value(), lossy.has_value());
    if (!lossy) continue;
    EXPECT_EQ(elastic->source.load.positions, c.load.positions);
    const int sectors = lossy->source.wheel.sectors, around = total_load_positions(lossy->source);
    EXPECT_GE(around, total_load_positions(c));
    EXPECT_LT(around, total_load_positions(c) + sectors);
    n_changed += sectors != c.wheel.sectors;
  }
  EXPECT_GT(n_changed, 3);
}

TEST(Starts, CanBeHalvedAsOftenAsTheCoarseGridsNeed) {
  expect_valid_starts(case_of(usual_wheel + "[optimizer]\ncoarse_levels = 2\n"), {0.66}, 1, 10);
}

TEST(Starts, FailedAttemptsAreBoundedAndCounted) {
  Case refused = case_of(usual_wheel + min_mass);
  refused.material.density.reset();
  const DrawnStart none = draw_start(refused, {0.66}, 1, 2);
  EXPECT_FALSE(none.start);
  EXPECT_GT(none.failed.refused, 0);
  EXPECT_LT(none.failed.refused, 50);
  EXPECT_FALSE(none.failed.refusal.empty());
  const DrawnStart full = draw_start(case_of(usual_wheel), {0.9999}, 1, 2);
  EXPECT_FALSE(full.start);
  EXPECT_GT(full.failed.off_volume, 0);
  int n_asked = 0;
  const DrawnStart ended = draw_start(case_of(usual_wheel), {0.9999}, 1, 2, [&] { return ++n_asked > 3; });
  EXPECT_FALSE(ended.start);
  EXPECT_EQ(ended.failed.total(), 3);
}

/// Points that keep their bounds.
std::vector<RatedPoint> points(const std::vector<std::vector<double>>& costs) {
  std::vector<RatedPoint> result;
  for (const auto& of_point : costs) result.push_back({of_point});
  return result;
}

/// By the definition: a front is what only earlier fronts dominate.
TEST(Pareto, FrontsAreThoseOfTheDefinition) {
  Random random(11, 0);
  std::vector<std::vector<double>> costs;
  for (int i = 0; i < 60; ++i)
    costs.push_back(
        {std::floor(random.uniform(0, 8)), std::floor(random.uniform(0, 8)), random.uniform(0, 1)});
  costs[17][1] = std::nan("");
  const std::vector<int> front = fronts(points(costs));
  EXPECT_EQ(front[17], 0);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (i == 17) continue;
    int deepest = 0;
    for (std::size_t k = 0; k < costs.size(); ++k)
      if (k != 17 && dominates(costs[k], costs[i])) deepest = std::max(deepest, front[k]);
    EXPECT_EQ(front[i], deepest + 1);
  }
  EXPECT_FALSE(dominates({1, 2}, {1, 2}));
  EXPECT_TRUE(dominates({1, 1}, {1, 2}));
  EXPECT_FALSE(dominates({0, 3}, {1, 2}));
}

TEST(Pareto, TheOrderHoldsTheBestOfEachCostFirstAndEveryFrontBeforeTheNext) {
  Random random(12, 0);
  std::vector<std::vector<double>> costs;
  for (int i = 0; i < 40; ++i) costs.push_back({random.uniform(0, 1), random.uniform(0, 1000)});
  costs.push_back({0.5, std::nan("")});
  const std::vector<int> order = spread_order(points(costs)), front = fronts(points(costs));
  EXPECT_EQ(order.size(), 40u);
  EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 40u);
  for (std::size_t k = 1; k < order.size(); ++k) EXPECT_LE(front[order[k - 1]], front[order[k]]);
  for (const int d : {0, 1}) {
    int best = 0;
    for (int i = 1; i < 40; ++i)
      if (costs[i][d] < costs[best][d]) best = i;
    EXPECT_TRUE(order[0] == best || order[1] == best);
  }
}

TEST(Pareto, ViolatedBoundsRankLast) {
  const std::vector<RatedPoint> designs{{{1, 1}, 0.02}, {{5, 5}}, {{0, 0}, 0.01}, {{6, 4}}, {{7, 7}}};
  EXPECT_EQ(fronts(designs), (std::vector<int>{4, 1, 3, 1, 2}));
  EXPECT_EQ(spread_order(designs), (std::vector<int>{1, 3, 4, 2, 0}));
}

// Three calls, each of which waits until all have begun.
TEST(Workers, CallAsManyAtATimeAsThereAreThreads) {
  std::atomic<int> begun = 0, together = 0;
  on_threads(3, 3, [&](int) {
    ++begun;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (begun < 3 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    together += begun == 3;
  });
  EXPECT_EQ(together, 3);
}

TEST(Workers, CallEachOnceOnAnyNumberOfThreads) {
  for (const int threads : {1, 3, 8}) {
    std::vector<std::atomic<int>> calls(50);
    on_threads(threads, 50, [&](int i) { ++calls[i]; });
    for (const auto& n : calls) EXPECT_EQ(n, 1);
  }
  std::atomic<int> begun = 0;
  EXPECT_THROW(on_threads(2, 1000,
                          [&](int i) {
                            ++begun;
                            if (i == 3) throw std::runtime_error("lost");
                            std::this_thread::sleep_for(std::chrono::microseconds(100));
                          }),
               std::runtime_error);
  EXPECT_LT(begun, 1000);
}

TEST(LockReach, IsThatOfTheDeepestMount) {
  const std::string mounts =
      "22 1 254:1 / / rw,relatime shared:1 - ext4 /dev/root rw\n"
      "23 22 0:41 / /home rw shared:2 master:3 - nfs4 server:/home "
      "rw,vers=4.2,local_lock=none,addr=10.0.0.1\n"
      "24 23 0:42 / /home/my\\040work rw - nfs server:/work rw,vers=3,nolock,local_lock=all\n"
      "25 22 0:43 / /scratch rw - lustre mgs:/fs rw,flock\n"
      "26 22 0:44 / /scratch/local rw - lustre mgs:/fs rw,localflock\n"
      "27 22 0:45 / /far rw - fuse.sshfs me@far: rw\n";
  for (const char* reaching : {"/", "/tmp/runs", "/home/me", "/homestead", "/home/my", "/scratch/x"})
    EXPECT_FALSE(why_locks_are_local(mounts, reaching)) << reaching;
  EXPECT_EQ(why_locks_are_local(mounts, "/home/my work/runs"), "nfs, mounted with nolock");
  EXPECT_EQ(why_locks_are_local(mounts, "/scratch/local"), "lustre, mounted with localflock");
  EXPECT_EQ(why_locks_are_local(mounts, "/far/away"), "fuse.sshfs");
  EXPECT_FALSE(why_locks_are_local("not mounts\n", "/far/away"));
}

TEST(NumberList, OfAllForms) {
  EXPECT_EQ(*parse_number_list("3,-1,2.5"), (std::vector<double>{3, -1, 2.5}));
  EXPECT_EQ(*parse_number_list("0:1:5"), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(*parse_number_list("0.6:0.9:4"), (std::vector<double>{0.6, 0.7, 0.8, 0.9}));
  const auto logarithmic = *parse_number_list("1:1000:4:log");
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(logarithmic[k], std::pow(10, k), 1e-9);
  for (const char* bad :
       {"", "a", "1,", "1:2", "1:2:1", "1:2:2.5", "0:1:3:log", "1:2:3:4", "1:2:3:lin", "nan"})
    EXPECT_FALSE(parse_number_list(bad)) << bad;
}

TEST(SetNumber, SetsAKeyInTheUnitOfTheFile) {
  Case c = case_of(usual_wheel);
  EXPECT_FALSE(set_number(c, "load.mass", 100));
  EXPECT_DOUBLE_EQ(c.load.force, 981);
  EXPECT_FALSE(set_number(c, "load.travel", 0.001));
  EXPECT_EQ(c.load.travel, 0.001);
  EXPECT_FALSE(set_number(c, "load.force", 500));
  EXPECT_FALSE(c.load.travel);
  EXPECT_FALSE(set_number(c, "holes.ring[1].radius", 0.03));
  EXPECT_EQ(c.holes.rings[0].radius, 0.03);
  EXPECT_FALSE(set_number(c, "grid.radial_cells", 42));
  EXPECT_EQ(c.grid.radial_cells, 42);
  const Case before = c;
  for (const auto& [key, value] : {std::pair{"load.mas", 1.0},
                                   {"holes.ring[2].radius", 0.03},
                                   {"grid.radial_cells", 4.5},
                                   {"material.poissons_ratio", 0.7},
                                   {"contact.method", 1.0},
                                   {"load.body_force", 1.0},
                                   {"mass", 1.0}})
    EXPECT_TRUE(set_number(c, key, value)) << key;
  EXPECT_EQ(c, before);
}

TEST(SetNumber, TakesUnitsAsACaseFileDoes) {
  Case c = case_of(usual_wheel + "[[constraint]]\nquantity = \"stiffness\"\nat_least = 1e6\n");
  EXPECT_FALSE(set_number(c, "wheel.outer_radius", 320, "mm"));
  EXPECT_DOUBLE_EQ(c.wheel.outer_radius, 0.32);
  EXPECT_FALSE(set_number(c, "constraint[1].at_least", 600, "N/mm"));  // on the whole width
  EXPECT_DOUBLE_EQ(*c.constraints[0].at_least, 600e3 / c.wheel.width);
  const Case before = c;
  EXPECT_TRUE(set_number(c, "constraint[1].at_least", 600, "MPa"));
  EXPECT_TRUE(set_number(c, "grid.radial_cells", 42, "mm"));
  EXPECT_EQ(c, before);
  const auto designs = sweep_designs(c, {}, "test.toml", {{"constraint[1].at_least", {700, 800}, "N/mm"}});
  ASSERT_TRUE(designs) << designs.failure().text;
  EXPECT_DOUBLE_EQ(*designs->back().source.constraints[0].at_least, 800e3 / c.wheel.width);
}

TEST(Sweep, HoldsEveryCombinationOnce) {
  const Case c = case_of(usual_wheel);
  const auto designs = sweep_designs(c, {}, "test.toml",
                                     {{"load.mass", {100, 200}}, {"objective.uniformity_dual", {0, 1, 10}}});
  ASSERT_TRUE(designs);
  ASSERT_EQ(designs->size(), 6u);
  EXPECT_DOUBLE_EQ((*designs)[4].source.load.force, 1962);
  EXPECT_EQ((*designs)[4].source.objective.uniformity_dual, 1);
  std::set<std::pair<double, double>> seen;
  for (const Design& design : *designs)
    seen.insert({design.source.load.force, design.source.objective.uniformity_dual});
  EXPECT_EQ(seen.size(), 6u);
  const auto bad = sweep_designs(c, {}, "test.toml", {{"holes.ring[1].radius", {0.03, 0.06}}});
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.failure().text.find("0.06"), std::string::npos);
  EXPECT_FALSE(sweep_designs(
      c, {}, "test.toml",
      {{"load.mass", std::vector<double>(40, 1)}, {"load.torque", std::vector<double>(40, 1)}}));
}

TEST(Sweep, OfAShareOfTheDistanceKeepsTheProportionsOfTheOthers) {
  const Case c = case_of(usual_wheel + R"(
[material]
fatigue_measure = "principal_strain"
fatigue_strain = 0.02
fatigue_exponent = 4
[[load.case]]
name = "rolling"
distance_share = 0.5
[[load.case]]
name = "kerb"
distance_share = 0.1
[[load.case]]
name = "corner"
distance_share = 0.4
)");
  const std::string first = "load.case[1].distance_share", second = "load.case[2].distance_share";
  const auto expect_shares = [](const Design& design, const std::array<double, 3>& expected) {
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(*design.source.load.cases[k].distance_share, expected[k], 1e-12) << design.text;
  };
  const auto designs = sweep_designs(c, {}, "test.toml", {{first, {0.9, 1}}});
  ASSERT_TRUE(designs) << designs.failure().text;
  expect_shares((*designs)[0], {0.9, 0.02, 0.08});
  expect_shares((*designs)[1], {1.0, 0.0, 0.0});
  const auto both = sweep_designs(c, {}, "test.toml", {{first, {0.3}}, {second, {0.6}}});
  ASSERT_TRUE(both) << both.failure().text;
  expect_shares(both->front(), {0.3, 0.6, 0.1});
  EXPECT_FALSE(sweep_designs(c, {}, "test.toml", {{first, {0.7}}, {second, {0.6}}}))
      << "more than the distance";
}

TEST(Sweep, FitsTheSizesOfTheGridThatTheFileDoesNotGive) {
  const Case c =
      case_of("[[holes.ring]]\ncount = 36\ncenter_radius = 0.27\nradius = 0.015\n[wheel]\nsectors = 4\n");
  const SweptKey sectors{"wheel.sectors", {4, 9, 18}};
  const auto fitted = sweep_designs(c, {}, "test.toml", {sectors});
  ASSERT_TRUE(fitted) << fitted.failure().text;
  for (const Design& design : *fitted) {
    EXPECT_EQ(design.source.grid.angular_cells % design.source.wheel.sectors, 0) << design.text;
    EXPECT_NEAR(design.source.grid.angular_cells, 384, 9) << design.text;
  }
  EXPECT_FALSE(sweep_designs(c, {.angular = true}, "test.toml", {sectors}));
  const auto swept =
      sweep_designs(c, {}, "test.toml", {{"grid.angular_cells", {384, 432}}, {"wheel.sectors", {4}}});
  ASSERT_TRUE(swept) << swept.failure().text;
  EXPECT_EQ(swept->back().source.grid.angular_cells, 432);
}

// The lines are divided after spaces and the marks of keys, where no space is lost.
TEST(ParetoPicture, ShowsWholeCaptions) {
  std::vector<RankedDesign> designs(2);
  const std::string key = "constraint[1].at_least = 320 N/mm",
                    more = ", load.case[2].distance_share = 0.123456789, a.b = 1";
  designs[0].design.text = "9 ellipses";
  designs[1].design.text = key + more;
  for (RankedDesign& design : designs) {
    design.front = 1;
    design.outline = "M0 0L1 0L0 1Z";
  }
  const std::string svg = pareto_svg(designs, ranked_quantities(), "title");
  std::string captions;
  const std::regex caption("<text class=\"small middle\"[^>]*>([^<]*)</text>");
  for (std::sregex_iterator match(svg.begin(), svg.end(), caption), end; match != end; ++match)
    captions += (*match)[1].str() + "|";
  const auto joined = [](std::string text, const char* part) {
    for (std::size_t i; (i = text.find(part)) != std::string::npos;) text.erase(i, std::string(part).size());
    return text;
  };
  EXPECT_EQ(joined(captions, "|"), joined("9 ellipses" + key + more, ", "));
  for (std::size_t from = 0, to; (to = captions.find('|', from)) != std::string::npos; from = to + 1)
    EXPECT_LE(to - from, 22u) << captions.substr(from, to - from);
}

class Exploration : public TemporaryFolder {
 protected:
  const Case small = case_of(R"(
[wheel]
sectors = 8
[load]
positions = 2
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 16
angular_cells = 128
tread_levels = 0
[optimizer]
rim_band = 0.00875
tread_band = 0.0175
iterations = 10
)");
  const std::vector<RankedQuantity> quantities{*find_quantity("stiffness"), *find_quantity("peak_pressure")};
  const ThreadLimit one_thread_each{1};

  DesignPlan exploration(const std::vector<Design>& designs) const {
    return {.name = "explore",
            .title = "Test",
            .has_previews = true,
            .quantities = quantities,
            .designs = designs};
  }

  static std::vector<RatedDesign> run_all(const fs::path& place, const std::vector<Design>& designs,
                                          const RunSettings& settings) {
    return run_planned(place, {.name = "sweep", .title = "Test", .designs = designs}, settings);
  }

  std::map<std::string, std::string> explored(const fs::path& place, RunSettings settings) {
    const auto designs =
        planned_designs(small, {.starts = 4, .seed = 3, .keeps_sectors = false, .quantities = quantities});
    if (!designs) throw std::runtime_error(designs.failure().detail);
    make_folder(place);
    const DesignPlan plan = exploration(*designs);
    FinalistSettings on_finer{.threads = settings.threads, .stop_requested = settings.stop_requested};
    on_finer.begin = [this](const std::vector<RatedDesign>& solved, double) { n_solved_ += solved.size(); };
    const auto rated = with_finer_numbers(place, run_planned(place, plan, settings), quantities, on_finer);
    write_designs(place, plan, rated);
    std::map<std::string, std::string> files;
    for (const char* name : {"explore.csv", "explore.json", "explore.html", "pareto.svg"})
      files[name] = content(place / name);
    for (const auto& entry : fs::directory_iterator(place / "designs"))
      if (entry.path().extension() == ".json") files[entry.path().filename()] = content(entry.path());
    return files;
  }

  /// The designs are run to their end in a new folder, and the finalists solved on a finer grid.
  std::vector<RatedDesign> run_with_finalists(const std::string& name, const std::vector<Design>& designs,
                                              const std::vector<RankedQuantity>& asked) {
    make_folder(folder() / name);
    return with_finer_numbers(folder() / name, run_all(folder() / name, designs, {.threads = 1}), asked, {});
  }

  /// The small wheel with one ring of holes, which a run leaves as it is.
  /// With elements that look too stiff where walls are thin.
  Case with_holes(int count, double radius) {
    Case c = small;
    c.grid.dilatation = DilatationKind::pointwise;
    c.holes.rings.front().count = count;
    c.holes.rings.front().radius = radius;
    c.optimizer.iterations = 0;
    c.optimizer.minimum_wall = c.optimizer.minimum_gap = 0;
    c.output.errors = ErrorEstimates::none;
    return c;
  }

  std::size_t n_solved_ = 0;  ///< designs that were solved on a finer grid
};

TEST_F(Exploration, IsTheSameForAnyNumberOfThreadsAndAfterAStop) {
  const auto once = explored(folder() / "one", {.threads = 1});
  EXPECT_EQ(explored(folder() / "two", {.threads = 2}), once);

  // Stopped again and again, and continued.
  int n_asked = 0;
  for (int attempt = 0; attempt < 12; ++attempt) {
    RunSettings settings{.threads = 1};
    n_asked = 0;
    settings.stop_requested = [&] { return ++n_asked > 9; };
    explored(folder() / "stopped", settings);
  }
  EXPECT_EQ(explored(folder() / "stopped", {.threads = 1}), once);
  for (const auto& entry : fs::directory_iterator(folder() / "one" / "designs"))
    if (entry.is_directory())
      expect_equal_results(entry.path(), folder() / "stopped" / "designs" / entry.path().filename());
}

// Each design is left at every shape, and continued by another call.
TEST_F(Exploration, OfDesignsThatPauseAtEveryShapeIsTheSame) {
  const auto once = explored(folder() / "one", {.threads = 1});
  const fs::path place = folder() / "pauses";
  std::map<std::string, std::vector<int>> shapes;
  RunSettings settings{.threads = 1};
  settings.pauses = [&](const Design& design, int shape) {
    shapes[design.name].push_back(shape);
    return true;
  };
  for (int n_before = -1, n = 0; n > n_before;) {
    n_before = n;
    explored(place, settings);
    n = 0;
    for (const auto& [name, of_design] : shapes) n += static_cast<int>(of_design.size());
  }
  EXPECT_EQ(explored(place, {.threads = 1}), once);
  EXPECT_EQ(shapes.size(), 4u);
  for (const auto& [name, of_design] : shapes)
    for (std::size_t k = 1; k < of_design.size(); ++k) EXPECT_EQ(of_design[k], of_design[k - 1] + 1);
  for (const auto& entry : fs::directory_iterator(folder() / "one" / "designs"))
    if (entry.is_directory()) expect_equal_results(entry.path(), place / "designs" / entry.path().filename());
}

RatedDesign full_design(const std::string& name, std::map<std::string, double> numbers,
                        double violation = 0) {
  RatedDesign one{{name, "start", {}, {}}, {Progression::full, "converged", 3}};
  one.result.numbers = std::move(numbers);
  one.result.violation = violation;
  return one;
}

TEST(Finalists, AreTheBestOfEveryQuantityAndTheFront) {
  const std::vector<RankedQuantity> asked{*find_quantity("stiffness"), *find_quantity("run_out")};
  std::vector<RatedDesign> designs;
  const auto add = [&](double stiffness, double run_out, double violation = 0) {
    designs.push_back(full_design(fmt::format("{:03}", designs.size()),
                                  {{"stiffness_N_per_m", stiffness}, {"run_out_m", run_out}}, violation));
  };
  add(9, 9);                                                      // 0: the stiffest, on the front
  add(8, 9.5);                                                    // 1: the second, dominated
  add(7, 9.6);                                                    // 2: the third
  add(6, 9.7);                                                    // 3: the fourth
  for (const double r : {4.0, 3.0, 2.0, 1.0}) add(1 + r / 2, r);  // 4 to 7: on the front
  add(99, 0.1, 0.02);                                             // 8: violates a bound
  add(1, 1.5);                                                    // 9: the second in run-out, dominated
  designs.push_back(full_design("010", {}));
  const auto chosen = finalists(designs, asked);
  EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()), (std::set<int>{0, 1, 2, 4, 5, 6, 7, 9}));
  EXPECT_EQ(chosen.size(), 8u);
  EXPECT_EQ(chosen.front(), 0);
  designs[0].result.progression = Progression::preview;
  const auto without = finalists(designs, asked);
  EXPECT_EQ(std::ranges::count(without, 0), 0);
}

TEST(Finalists, NumbersAreReadBackToTheLastBit) {
  const FinerNumbers finer{.grid = "56 x 768 cells",
                           .failure = "",
                           .numbers = {{"run_out_m", 1.0 / 3}, {"run_out_m in kerb", 2e-300}},
                           .errors = {{"run_out_m", 0.1}, {"run_out_m in kerb", 0}},
                           .violation = 1.0 / 7};
  EXPECT_EQ(to_json(finer_numbers(to_json(finer))), to_json(finer));
  EXPECT_EQ(finer_numbers(to_json(finer)).numbers, finer.numbers);
  EXPECT_EQ(finer_numbers(to_json(finer)).violation, finer.violation);
}

TEST(Finalists, AreRankedAndShownByTheirFinerNumbers) {
  const std::vector<RankedQuantity> asked{*find_quantity("run_out")};
  std::vector<RatedDesign> designs;
  for (const double run_out : {1e-6, 2e-6, 3e-6})
    designs.push_back(full_design(fmt::format("{:03}", designs.size()), {{"run_out_m", run_out}}));
  designs[0].finer = FinerNumbers{.numbers = {{"run_out_m", 2.5e-6}}, .errors = {{"run_out_m", 0.4e-6}}};
  designs[1].finer = FinerNumbers{.numbers = {{"run_out_m", 2.1e-6}}, .errors = {{"run_out_m", 0.1e-6}}};
  auto order = ranked(designs, asked);
  EXPECT_EQ(order[0].design.name, "001");
  EXPECT_EQ(order[1].design.name, "000");
  const auto undecided = undecided_designs(order, asked);
  ASSERT_EQ(undecided.size(), 1u);
  EXPECT_EQ(undecided[0].designs, (std::vector<std::string>{"001", "000"}));
  EXPECT_NE(designs_table(order, asked, 5).find("2.10 +- 0.10"), std::string::npos);
  const auto json = nlohmann::json::parse(designs_json(order, asked));
  EXPECT_EQ(json["designs"][0]["numbers"]["run_out_m"], 2e-6);
  EXPECT_EQ(json["designs"][0]["on_finer_grid"]["numbers"]["run_out_m"], 2.1e-6);
  EXPECT_EQ(json["designs"][0]["on_finer_grid"]["errors"]["run_out_m"], 0.1e-6);
  EXPECT_FALSE(json["designs"][2].contains("on_finer_grid"));
  EXPECT_EQ(json["within_errors"][0]["designs"].size(), 2u);
  const auto csv = split(designs_csv(order), '\n');
  const auto names = split(csv[0], ',');
  const auto column = std::ranges::find(names, "run_out_m on a finer grid") - names.begin();
  EXPECT_EQ(std::stod(split(csv[1], ',').at(column)), 2.1e-6);
  EXPECT_EQ(std::stod(split(csv[1], ',').at(column + 1)), 0.1e-6);
  designs[1].finer->errors["run_out_m"] = designs[0].finer->errors["run_out_m"] = 0.1e-6;
  order = ranked(designs, asked);
  EXPECT_TRUE(undecided_designs(order, asked).empty());
}

// On their own grids the numbers of others are too good to be compared with.
TEST(Finalists, AreNotBehindDesignsThatAreBetterOnlyOnACoarserGrid) {
  const std::vector<RankedQuantity> asked{*find_quantity("run_out")};
  std::vector<RatedDesign> designs;
  for (const double run_out : {1e-6, 2e-6, 3e-6})
    designs.push_back(full_design(fmt::format("{:03}", designs.size()), {{"run_out_m", run_out}}));
  designs[0].finer = FinerNumbers{.numbers = {{"run_out_m", 5e-6}}, .errors = {{"run_out_m", 1e-6}}};
  designs[2].finer = FinerNumbers{.numbers = {{"run_out_m", 4e-6}}, .errors = {{"run_out_m", 1e-6}}};
  designs.push_back(full_design("003", {{"run_out_m", 0.1e-6}}, 0.02));  // violates a bound
  const auto order = ranked(designs, asked);
  std::vector<std::string> names;
  for (const RankedDesign& one : order) names.push_back(one.design.name);
  EXPECT_EQ(names, (std::vector<std::string>{"002", "000", "001", "003"}));
  EXPECT_EQ(order[0].front, 1);
  EXPECT_EQ(order[2].front, 2);
  EXPECT_EQ(finalists(designs, asked).front(), 1);  // it is worth a look
}

/// The stiffness of the initial shape on the grid of the results, or on the finer one [N/m of width].
double initial_stiffness(const Case& c, bool is_on_finer) {
  const auto own = rolling_model<2>(with_levels_of_results(c));
  const auto model = is_on_finer ? on_finer_grid(own) : own;
  const auto solver = make_solver(model);
  if (!solver) throw std::runtime_error(solver.failure().detail);
  const LevelSet<2> shape = on_grid(initial_shape<2>(c), model.grid);
  const auto states = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
  if (!states) throw std::runtime_error(states.failure().detail);
  return shape_summary<2>(**solver, **states).stiffness;
}

// Walls of 1.2 cells look stiffer than they are, by more than thick ones. The other wheel's holes are widened
// until it looks softer by half of that.
TEST_F(Exploration, FinalistsAreInTheOrderOfTheFinerGridWhereTheirOwnLies) {
  const Case thin = with_holes(24, 0.0273);
  const double looks = initial_stiffness(thin, false), is = initial_stiffness(thin, true);
  double narrow = 0.03, wide = 0.06;
  const auto behind = [&](double radius) {  // half of the difference of both errors
    const Case c = with_holes(8, radius);
    const double of_thick = initial_stiffness(c, false) - initial_stiffness(c, true);
    return looks - initial_stiffness(c, false) - 0.5 * ((looks - is) - of_thick);
  };
  ASSERT_LT(behind(narrow), 0);
  ASSERT_GT(behind(wide), 0);
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (narrow + wide);
    (behind(middle) < 0 ? narrow : wide) = middle;
  }
  const Case thick = with_holes(8, narrow);
  ASSERT_GT(looks, initial_stiffness(thick, false));
  ASSERT_LT(is, initial_stiffness(thick, true));
  const std::vector<RankedQuantity> asked{*find_quantity("stiffness")};
  const std::vector<Design> designs{{"001", "thin walls", thin, {}}, {"002", "thick walls", thick, {}}};
  auto rated = run_with_finalists("all", designs, asked);
  const auto by_finer = ranked(rated, asked);
  EXPECT_EQ(by_finer[0].design.name, "002");
  EXPECT_EQ(by_finer[0].front, 1);
  EXPECT_EQ(by_finer[1].front, 2);
  EXPECT_NEAR(by_finer[1].value("stiffness_N_per_m"), is * thin.wheel.width, 1e-6 * is * thin.wheel.width);
  EXPECT_EQ(undecided_designs(by_finer, asked).size(), 1u);
  for (RatedDesign& one : rated) one.finer.reset();
  const auto by_own = ranked(rated, asked);
  EXPECT_EQ(by_own[0].design.name, "001");
  EXPECT_NEAR(by_own[0].value("stiffness_N_per_m"), looks * thin.wheel.width,
              1e-6 * looks * thin.wheel.width);
}

// The bound is just kept on the grid of the run.
TEST_F(Exploration, FinalistsThatViolateABoundOnTheFinerGridAreMarked) {
  Case c = with_holes(24, 0.0273);
  const double own = initial_stiffness(c, false), finer = initial_stiffness(c, true);
  ASSERT_GT(own - finer, 2e-3 * own);
  c.constraints = {{.quantity = built_in("stiffness"), .at_least = own}};
  Case loose = c;
  loose.constraints[0].at_least = 0.9 * finer;
  const std::vector<RankedQuantity> asked{*find_quantity("stiffness")};
  const auto order =
      ranked(run_with_finalists("all", {{"001", "tight", c, {}}, {"002", "loose", loose, {}}}, asked), asked);
  ASSERT_EQ(order.size(), 2u);
  for (const RankedDesign& one : order) {
    EXPECT_EQ(one.result.violation, 0);
    EXPECT_EQ(one.front, 1);  // as far as its own grid tells
    ASSERT_TRUE(one.finer);
    const bool is_tight = one.design.name == "001";
    EXPECT_NEAR(one.finer->violation, is_tight ? (own - finer) / own : 0, 1e-6);
    const std::string table = designs_table({one}, asked, 1), page = designs_page({one}, asked, "Test");
    EXPECT_EQ(table.find("violates a bound") != std::string::npos, is_tight) << table;
    EXPECT_EQ(page.find("violates a bound") != std::string::npos, is_tight);
  }
}

TEST_F(Exploration, OfMinimumMassRanksFeasibleDesignsFirst) {
  Case lightest = small;
  lightest.material.density = 1100;
  lightest.objective.minimize = built_in("mass");
  lightest.constraints = {{.quantity = built_in("stiffness"), .at_least = 40e6}};
  lightest.optimizer.iterations = 20;
  const std::vector<RankedQuantity> asked{*find_quantity("mass"), *find_quantity("run_out")};
  const auto designs =
      planned_designs(lightest, {.starts = 4, .seed = 3, .keeps_sectors = false, .quantities = asked});
  ASSERT_TRUE(designs) << designs.failure().detail;
  EXPECT_EQ(designs->size(), 4u);
  make_folder(folder() / "mass");
  const DesignPlan plan{
      .name = "explore", .title = "Test", .has_previews = true, .quantities = asked, .designs = *designs};
  const auto order = ranked(run_planned(folder() / "mass", plan, {.threads = 1}), asked);
  ASSERT_EQ(order.size(), 4u);
  const double initial = initial_volume(small);
  bool was_kept = true;
  for (const RankedDesign& one : order) {
    const bool is_kept = one.result.value("stiffness_N_per_m") / small.wheel.width > 40e6 * (1 - 1e-3);
    EXPECT_EQ(one.front > 0, is_kept) << one.design.text << " misses its bound by " << one.result.violation;
    EXPECT_TRUE(was_kept || !is_kept);
    was_kept = is_kept;
  }
  EXPECT_GT(order.front().front, 0);
  EXPECT_LT(order.front().result.numbers.at("volume_fraction"), initial);
}

TEST_F(Exploration, GeneratesStartsWithinTheTimeLimit) {
  DrawingSettings settings;
  int n_starts = 0;
  bool has_ended = false;
  settings.must_end = [&] { return n_starts == 3; };
  settings.report = [&](const DrawingProgress& progress) {
    n_starts = progress.n_starts;
    has_ended = progress.has_ended;
  };
  const ExplorationSettings plan{.starts = 999, .seed = 3, .keeps_sectors = false, .quantities = quantities};
  const auto some = planned_designs(small, plan, settings);
  ASSERT_TRUE(some);
  EXPECT_TRUE(has_ended);
  ASSERT_EQ(some->size(), 3u);
  const auto four =
      planned_designs(small, {.starts = 4, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(four);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ((*some)[i].source, (*four)[i].source);
}

TEST_F(Exploration, WithoutAnyStartReportsTheFailures) {
  Case refused = small;
  refused.holes = {};
  refused.volume.target = 0.66;
  refused.grid.degree = 7;
  const auto designs =
      planned_designs(refused, {.starts = 60, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_FALSE(designs);
  EXPECT_NE(designs.failure().detail.find("grid.degree"), std::string::npos) << designs.failure().detail;
}

TEST_F(Exploration, DesignWithFolderInUseHasNoResult) {
  const auto designs =
      planned_designs(small, {.starts = 2, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  make_folder(folder() / "all");
  make_subfolder(folder() / "all" / "designs");
  make_subfolder(folder() / "all" / "designs" / "002");
  const auto held = FolderLock::acquire(folder() / "all" / "designs" / "002");
  ASSERT_TRUE(held);
  std::vector<std::string> left_out;
  RunSettings settings{.threads = 1};
  settings.left_out = [&](const Design& design, const std::string& why) {
    left_out.push_back(design.name);
    EXPECT_NE(why.find(std::to_string(::getpid())), std::string::npos) << why;
  };
  const auto rated = run_all(folder() / "all", *designs, settings);
  ASSERT_EQ(rated.size(), 1u);
  EXPECT_EQ(rated[0].design.name, "001");
  EXPECT_EQ(left_out, std::vector<std::string>{"002"});
  EXPECT_FALSE(fs::exists(folder() / "all" / "designs" / "002.full.json"));
}

TEST_F(Exploration, APlanIsReadBackAsItWasWritten) {
  const auto designs =
      planned_designs(small, {.starts = 12, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  make_folder(folder() / "all");
  write_plan(folder() / "all", exploration(*designs));
  const auto read = read_plan(folder() / "all");
  ASSERT_TRUE(read) << read.failure().text;
  ASSERT_EQ(read->designs.size(), designs->size());
  for (std::size_t i = 0; i < designs->size(); ++i) {
    EXPECT_EQ(read->designs[i].name, (*designs)[i].name);
    EXPECT_EQ(read->designs[i].text, (*designs)[i].text);
    EXPECT_EQ(read->designs[i].parameters, (*designs)[i].parameters);
    EXPECT_EQ(to_toml(read->designs[i].source), to_toml((*designs)[i].source));
  }
  EXPECT_TRUE(read->has_previews && read->is_complete && read->solves_finalists);
  EXPECT_TRUE(
      std::ranges::equal(read->quantities, quantities, {}, &RankedQuantity::key, &RankedQuantity::key));
}

// A process that dies between the end of a preview and the storage of its result leaves a run that is over.
TEST_F(Exploration, APreviewWhoseResultWasNotStoredIsNotContinued) {
  Case longer = small;
  longer.optimizer.iterations = 24;
  const auto designs =
      planned_designs(longer, {.starts = 1, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  const fs::path place = folder() / "all", result = place / "designs" / "001.preview.json";
  make_folder(place);
  run_designs(place, *designs, Progression::preview, {.threads = 1});
  const std::string before = content(result);
  const auto files = results(place / "designs" / "001");
  ASSERT_EQ(design_result(before).shapes, 15);
  fs::remove(result);
  run_designs(place, *designs, Progression::preview, {.threads = 1});
  EXPECT_EQ(content(result), before);
  EXPECT_EQ(results(place / "designs" / "001"), files);
}

TEST_F(Exploration, ADesignThatAnotherProcessRunsIsWaitedFor) {
  const auto designs =
      planned_designs(small, {.starts = 2, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  const fs::path place = folder() / "all";
  make_folder(place);
  prepare_designs(place, *designs);
  auto held = std::make_optional(FileLock::acquire(lock_of_design(place, designs->back())));
  ASSERT_TRUE(*held);
  RunSettings settings{.threads = 1};
  std::vector<std::string> done;
  int n_asked = 0;
  settings.done = [&](const Design& design, const DesignResult&) { done.push_back(design.name); };
  settings.waits = [&](const Design& design, const FolderInUse& holder) {
    EXPECT_EQ(design.name, "002");
    EXPECT_EQ(holder.process, ::getpid());
    if (++n_asked == 3) held.reset();  // it died
    return true;
  };
  const auto rated = run_all(place, *designs, settings);
  EXPECT_EQ(rated.size(), 2u);
  EXPECT_EQ(n_asked, 3);
  EXPECT_EQ(done, (std::vector<std::string>{"001", "002"}));
}

// The choices depend on the results only: those of a process that had no time for all designs do not remain.
TEST_F(Exploration, StepsOfAPlanAreDueInTurn) {
  const auto designs =
      planned_designs(small, {.starts = 4, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  const fs::path place = folder() / "steps";
  make_folder(place);
  const DesignPlan plan = exploration(*designs);
  prepare_designs(place, *designs);
  int n_previews = 0;
  for (Standing now = standing(place, plan); !now.due.empty(); now = standing(place, plan)) {
    if (now.progression == Progression::preview) {
      EXPECT_EQ(now.due.size() + n_previews++, designs->size());
    } else {
      EXPECT_EQ(n_previews, static_cast<int>(designs->size()));
    }
    run_designs(place, {now.due.back()}, now.progression, {.threads = 1});  // backwards, one by one
  }
  write_designs(place, plan, standing(place, plan).designs);
  const fs::path straight = folder() / "straight";
  make_folder(straight);
  write_designs(straight, plan, run_planned(straight, plan, {.threads = 2}));
  for (const char* name : {"explore.csv", "explore.json", "explore.html", "pareto.svg"})
    EXPECT_EQ(content(place / name), content(straight / name)) << name;
}

TEST_F(Exploration, KnownResultsAreReused) {
  explored(folder() / "one", {.threads = 1});
  EXPECT_GE(n_solved_, 1u);
  n_solved_ = 0;
  int n_runs = 0;
  RunSettings settings{.threads = 1};
  settings.may_begin = [&] { return ++n_runs, true; };
  explored(folder() / "one", settings);
  EXPECT_EQ(n_runs, 0);
  EXPECT_EQ(n_solved_, 0u);
}

// A preview may beat the designs that were optimized to the end; the walls and gaps of their ends it does not
// have.
TEST_F(Exploration, UnbeatenDesignsAreAllOptimizedToTheEnd) {
  Case longer = small;
  longer.optimizer.iterations = 24;
  const auto designs =
      planned_designs(longer, {.starts = 6, .seed = 6, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  make_folder(folder() / "all");
  const auto rated = run_planned(folder() / "all", exploration(*designs), {.threads = 1});
  const auto front = fronts(rated_points(rated, quantities));
  int n_full = 0;
  for (std::size_t i = 0; i < rated.size(); ++i) {
    n_full += rated[i].result.progression == Progression::full;
    if (front[i] == 1) {
      EXPECT_EQ(rated[i].result.progression, Progression::full) << rated[i].design.name;
    }
  }
  EXPECT_LT(n_full, static_cast<int>(rated.size()));
}

TEST_F(Exploration, EveryDesignHasTheVolumeOfTheCaseAndARunThatOpens) {
  const auto designs =
      planned_designs(small, {.starts = 3, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  make_folder(folder() / "all");
  const double volume = initial_volume(small);
  for (const RatedDesign& one : run_planned(folder() / "all", exploration(*designs), {.threads = 1})) {
    EXPECT_NEAR(one.result.numbers.at("volume_fraction"), volume, 1e-5);
    const fs::path run = folder() / "all" / "designs" / one.design.name;
    const CaseResult read = read_case(run / "case.toml");
    EXPECT_TRUE(read.value) << read.problems.front().text();
    EXPECT_TRUE(fs::exists(run / "report.html") && fs::exists(run / "shape.levelset"));
  }
}

}  // namespace
}  // namespace wheelwright::testing
