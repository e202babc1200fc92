#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>
#include <thread>

#include "tests/run_support.h"
#include "wheelwright/app/number_list.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/set_number.h"
#include "wheelwright/case/write.h"
#include "wheelwright/explore/exploration.h"
#include "wheelwright/explore/pareto.h"
#include "wheelwright/explore/sweep.h"
#include "wheelwright/explore/workers.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/study.h"
#include "wheelwright/starts/draft.h"
#include "wheelwright/starts/random.h"
#include "wheelwright/starts/start.h"

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
    const auto start = draw_start(c, range, seed, number);
    ASSERT_TRUE(start) << number << ", seed " << seed << ", volume " << range.volume;
    SCOPED_TRACE(start->text);
    const CaseResult again = parse_case(to_toml(start->source), "start.toml");
    ASSERT_TRUE(again.value);
    EXPECT_TRUE(lost_on_the_grid<2>(start->source).empty());
    EXPECT_NEAR(initial_volume(start->source), range.volume, 0.01);
    EXPECT_EQ(start->source.volume.target, range.volume);
    if (range.keeps_sectors) {
      EXPECT_EQ(start->source.wheel.sectors % c.wheel.sectors, 0);
    }
    kinds.insert(start->text.substr(start->text.find(' ') + 1));
    const auto same = draw_start(c, range, seed, number);
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

/// By the definition: a front is what only earlier fronts dominate.
TEST(Pareto, FrontsAreThoseOfTheDefinition) {
  Random random(11, 0);
  std::vector<std::vector<double>> costs;
  for (int i = 0; i < 60; ++i)
    costs.push_back(
        {std::floor(random.uniform(0, 8)), std::floor(random.uniform(0, 8)), random.uniform(0, 1)});
  costs[17][1] = std::nan("");
  const std::vector<int> front = fronts(costs);
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
  const std::vector<int> order = spread_order(costs), front = fronts(costs);
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

TEST(NumberList, OfAllForms) {
  EXPECT_EQ(*parse_number_list("3,-1,2.5"), (std::vector<double>{3, -1, 2.5}));
  EXPECT_EQ(*parse_number_list("0:1:5"), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  const auto logarithmic = *parse_number_list("1:1000:4:log");
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(logarithmic[k], std::pow(10, k), 1e-9);
  for (const char* bad :
       {"", "a", "1,", "1:2", "1:2:1", "1:2:2.5", "0:1:3:log", "1:2:3:4", "1:2:3:lin", "nan"})
    EXPECT_FALSE(parse_number_list(bad)) << bad;
}

TEST(SetNumber, GivesAKeyItsValueInTheUnitOfTheFile) {
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

TEST(Sweep, HoldsEveryCombinationOnce) {
  const Case c = case_of(usual_wheel);
  const auto designs =
      sweep_designs(c, "test.toml", {{"load.mass", {100, 200}}, {"objective.uniformity_dual", {0, 1, 10}}});
  ASSERT_TRUE(designs);
  ASSERT_EQ(designs->size(), 6u);
  EXPECT_DOUBLE_EQ((*designs)[4].source.load.force, 1962);
  EXPECT_EQ((*designs)[4].source.objective.uniformity_dual, 1);
  std::set<std::pair<double, double>> seen;
  for (const Design& design : *designs)
    seen.insert({design.source.load.force, design.source.objective.uniformity_dual});
  EXPECT_EQ(seen.size(), 6u);
  const auto bad = sweep_designs(c, "test.toml", {{"holes.ring[1].radius", {0.03, 0.06}}});
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.failure().text.find("0.06"), std::string::npos);
  EXPECT_FALSE(sweep_designs(
      c, "test.toml",
      {{"load.mass", std::vector<double>(40, 1)}, {"load.torque", std::vector<double>(40, 1)}}));
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

  std::map<std::string, std::string> explored(const fs::path& place, RunSettings settings) {
    const auto designs =
        planned_designs(small, {.starts = 4, .seed = 3, .keeps_sectors = false, .quantities = quantities});
    if (!designs) throw std::runtime_error(designs.failure().detail);
    make_folder(place);
    const auto rated = explore(place, *designs, quantities, settings);
    write_designs(place, "explore", rated, quantities, "Test");
    std::map<std::string, std::string> files;
    for (const char* name : {"explore.csv", "explore.json", "explore.html", "pareto.svg"})
      files[name] = content(place / name);
    return files;
  }
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

TEST_F(Exploration, WhatIsKnownIsNotRunAgain) {
  explored(folder() / "one", {.threads = 1});
  int n_runs = 0;
  RunSettings settings{.threads = 1};
  settings.may_begin = [&] { return ++n_runs, true; };
  explored(folder() / "one", settings);
  EXPECT_EQ(n_runs, 0);
}

TEST_F(Exploration, EveryDesignHasTheVolumeOfTheCaseAndARunThatOpens) {
  const auto designs =
      planned_designs(small, {.starts = 3, .seed = 3, .keeps_sectors = false, .quantities = quantities});
  ASSERT_TRUE(designs);
  make_folder(folder() / "all");
  const double volume = initial_volume(small);
  for (const RatedDesign& one : explore(folder() / "all", *designs, quantities, {.threads = 1})) {
    EXPECT_NEAR(one.result.numbers.at("volume_fraction"), volume, 1e-5);
    const fs::path run = folder() / "all" / "designs" / one.design.name;
    const CaseResult read = read_case(run / "case.toml");
    EXPECT_TRUE(read.value) << read.problems.front().text();
    EXPECT_TRUE(fs::exists(run / "report.html") && fs::exists(run / "shape.levelset"));
  }
}

}  // namespace
}  // namespace wheelwright::testing
