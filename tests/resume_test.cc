#include <csignal>
#include <regex>

#include "tests/run_support.h"
#include "wheelwright/app/execute.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/version.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/checkpoints/checkpoint_folder.h"
#include "wheelwright/run/checkpoints/folder_lock.h"

namespace wheelwright::testing {
namespace {

/// What the commands print goes to the test's log only when they fail.
class Quiet {
 public:
  Quiet() {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
  }
  ~Quiet() {
    ::testing::internal::GetCapturedStdout();
    ::testing::internal::GetCapturedStderr();
  }
};

class Resume : public TemporaryFolder {
 protected:
  /// The case in a folder of its own: "run" in it is the run's, so that case.toml says the same everywhere.
  fs::path workplace(const std::string& name) {
    fs::create_directories(folder() / name);
    return folder() / name;
  }

  int run(const fs::path& where, const std::string& text, std::optional<int> iterations = {}) {
    return in(where, [&] {
      Case c = *parse_case(text, "case.toml").value;
      if (iterations) c.optimizer.iterations = *iterations;
      Signals signals;
      return begin_run(c, c.output.folder, signals);
    });
  }

  int resume(const fs::path& where, std::optional<int> iterations = {}) {
    return in(where, [&] {
      Case c = *read_case("run/case.toml").value;
      if (iterations) c.optimizer.iterations = *iterations;
      Signals signals;
      return resume_run(c, "run", signals);
    });
  }

  void expect_the_same_from_every_stop(const std::string& text, int iterations) {
    const fs::path straight = workplace("straight");
    ASSERT_EQ(run(straight, text), exit_done);
    for (int k = 0; k < iterations; ++k) {
      const fs::path stopped = workplace(std::to_string(k));
      ASSERT_EQ(run(stopped, text, k), exit_done);
      ASSERT_EQ(resume(stopped, iterations), exit_done);
      SCOPED_TRACE(fmt::format("stopped after shape {}", k));
      expect_equal_results(straight / "run", stopped / "run");
      fs::remove_all(stopped);
    }
  }

 private:
  template <class Work>
  static int in(const fs::path& where, Work work) {
    const Quiet quiet;
    const fs::path before = fs::current_path();
    fs::current_path(where);
    const int code = work();
    fs::current_path(before);
    return code;
  }
};

std::vector<std::string> checkpoint_names(const fs::path& run) {
  std::vector<std::string> names;
  for (const fs::path& file : CheckpointFolder(run).files()) names.push_back(file.stem().string());
  return names;
}

int rows(const fs::path& run) {
  return static_cast<int>(split(content(run / "history.csv"), '\n').size()) - 1;
}

void flip_a_bit(const fs::path& file) {
  std::string bytes = content(file);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(Resume, TwentyShapesAreTheSameFromEveryStop) {
  expect_the_same_from_every_stop(small_case_of_any_width(20), 20);
}

TEST_F(Resume, AHeldMeanIsPartOfTheState) {
  expect_the_same_from_every_stop(small_case_of_any_width(6, R"(
[objective]
strain_energy = 1
uniformity_dual = 10
mean = "held"
)"),
                                  6);
}

TEST_F(Resume, RadiiOfLayersContinueIdentically) {
  std::string text = small_case_of_any_width(5, R"(
[[material.layer]]
name = "core"
outer_radius = 0.262
outer_radius_range = [0.25, 0.28]
youngs_modulus = 900e6
poissons_ratio = 0.3
)");
  // Rows are higher outside of the layer, and the band has two of them.
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"tread_band = 0.035", "tread_band = 0.045"},
        {"rim_band = 0.0175", "rim_band = 0.02"},
        {"radius = 0.03", "radius = 0.02"}})
    text.replace(text.find(from), from.size(), to);
  expect_the_same_from_every_stop(text, 5);
}

TEST_F(Resume, PositionsBetweenColumnsContinueIdentically) {
  std::string text = small_case_of_any_width(4, "[objective]\nstrain_energy = 1\nuniformity_dual = 10\n");
  const std::string positions = "positions = 2";
  text.replace(text.find(positions), positions.size(), "positions = 7");
  expect_the_same_from_every_stop(text, 4);
}

TEST_F(Resume, PapersRuleAndWeightsContinueIdentically) {
  expect_the_same_from_every_stop(small_case_of_any_width(5, R"(
[objective]
strain_energy = 1
annulus_matches_dual = 10
[volume]
control = "paper"
)"),
                                  5);
}

/// The wheel with its width.
std::string small_case_in_3d(int iterations) {
  std::string text = small_case_of_any_width(iterations, R"([material]
poissons_ratio = 0.3
[contact]
quadrature_points = 2
)");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("[wheel]\n", "[wheel]\ndimension = 3\n");
  replace("radial_cells = 8\n", "radial_cells = 8\naxial_cells = 2\ndegree = 1\n");
  return text;
}

// With holes that change along the width.
TEST_F(Resume, WheelIn3DContinuesIdentically) {
  expect_the_same_from_every_stop(small_case_in_3d(3), 3);
  EXPECT_TRUE(fs::exists(folder() / "straight/run/pressures_final.csv"));
}

// The wheel leans, so that the parting plane is not in the middle.
TEST_F(Resume, AFoundPartingPlaneContinuesIdentically) {
  std::string text = small_case_in_3d(2);
  for (const auto& [section, keys] :
       {std::pair<std::string, std::string>{"[load]\n", "camber = 3\n"},
        {"[optimizer]\n", "made = \"moulded\"\nparting = \"found\"\ndraft = 2\n"}})
    text.insert(text.find(section) + section.size(), keys);
  expect_the_same_from_every_stop(text, 2);
  const auto c = read_case((folder() / "straight/run/case.toml").string());
  ASSERT_TRUE(c.value);
  EXPECT_EQ(c.value->optimizer.parting, Parting::given);
  EXPECT_NE(c.value->optimizer.parting_plane, 0.5 * c.value->wheel.width);
}

// On the way to the target, at it, and after it: 81 % of the ring become 75 % in four shapes.
TEST_F(Resume, ChangingVolumeContinuesIdentically) {
  expect_the_same_from_every_stop(small_case_of_any_width(6, "[volume]\ntarget = 0.75\nrate = 0.02\n"), 6);
  const auto history = split(content(folder() / "straight/run/history.csv"), '\n');
  const auto header = split(history.front(), ',');
  const auto column = std::ranges::find(header, "volume fraction [-]") - header.begin();
  EXPECT_GT(std::stod(split(history[1], ',')[column]), 0.8);
  EXPECT_NEAR(std::stod(split(history.back(), ',')[column]), 0.75, 1e-6);
}

TEST_F(Resume, KeepsTwoAndUsesTheOlderIfTheNewestIsCorrupt) {
  const fs::path straight = workplace("straight"), damaged = workplace("damaged");
  ASSERT_EQ(run(straight, small_case_of_any_width(8)), exit_done);
  ASSERT_EQ(run(damaged, small_case_of_any_width(8)), exit_done);
  EXPECT_EQ(checkpoint_names(damaged / "run"), (std::vector<std::string>{"shape_000008", "shape_000006"}));
  flip_a_bit(damaged / "run/checkpoints/shape_000008.checkpoint");
  fs::remove(damaged / "run/comparison.svg");
  ASSERT_EQ(resume(damaged), exit_done);
  expect_equal_results(straight / "run", damaged / "run");
}

TEST_F(Resume, IsRefusedWithoutAValidCheckpoint) {
  const fs::path place = workplace("all-bad");
  ASSERT_EQ(run(place, small_case_of_any_width(4)), exit_done);
  const auto before = results(place / "run");
  for (const fs::path& file : CheckpointFolder(place / "run").files()) flip_a_bit(file);
  EXPECT_EQ(resume(place, 6), exit_checkpoint);
  EXPECT_EQ(results(place / "run"), before);
}

TEST_F(Resume, NeverRestartsIfCheckpointsAreMissing) {
  const fs::path place = workplace("gone");
  ASSERT_EQ(run(place, small_case_of_any_width(3)), exit_done);
  fs::remove_all(place / "run/checkpoints");
  const auto before = results(place / "run");
  EXPECT_EQ(resume(place), exit_checkpoint);
  EXPECT_EQ(results(place / "run"), before);
}

TEST_F(Resume, IsRefusedForAnotherCaseOrHistory) {
  const fs::path place = workplace("changed");
  ASSERT_EQ(run(place, small_case_of_any_width(2)), exit_done);
  const std::string good = content(place / "run/case.toml");
  std::string other = good;
  other.replace(other.find("friction = 0\n"), 13, "friction = 1\n");
  std::ofstream(place / "run/case.toml") << other;
  EXPECT_EQ(resume(place, 3), exit_checkpoint);
  std::ofstream(place / "run/case.toml") << good;
  EXPECT_EQ(resume(place, 3), exit_done);

  std::string history = content(place / "run/history.csv");
  history[history.size() / 2] ^= 1;
  std::ofstream(place / "run/history.csv") << history;
  EXPECT_EQ(resume(place, 4), exit_checkpoint);
  fs::remove(place / "run/history.csv");
  EXPECT_EQ(resume(place, 4), exit_checkpoint);
}

/// A checkpoint that agrees with itself but holds speeds where the case moves the boundary by vectors.
TEST_F(Resume, IsRefusedForMovesOfAnotherKind) {
  const fs::path place = workplace("other-moves");
  ASSERT_EQ(run(place, small_case_of_any_width(4)), exit_done);
  for (const fs::path& file : CheckpointFolder(place / "run").files()) {
    auto checkpoint = *parse_checkpoint_file<2>(content(file));
    ASSERT_FALSE(checkpoint.state.memory.pairs.empty());
    for (CurvaturePair& pair : checkpoint.state.memory.pairs)
      for (auto* values : {&pair.move, &pair.change}) values->resize(checkpoint.state.shape.values.size());
    std::ofstream(file, std::ios::binary) << checkpoint_file(checkpoint);
  }
  EXPECT_EQ(resume(place, 6), exit_checkpoint);
}

TEST_F(Resume, TheCaseOfARunNamesWhatComputedIt) {
  const fs::path place = workplace("named");
  ASSERT_EQ(run(place, small_case_of_any_width(0)), exit_done);
  const std::string first_line = split(content(place / "run/case.toml"), '\n').front();
  const std::string source = WHEELWRIGHT_SOURCE_DIR;
  EXPECT_TRUE(first_line.starts_with(fmt::format("# wheelwright {}, commit ", version()))) << first_line;
  EXPECT_TRUE(first_line.ends_with(fmt::format(", compiled by {}", compiler()))) << first_line;
  const bool has_commit = std::regex_search(first_line, std::regex("commit [0-9a-f]{12}\\+?,"));
  EXPECT_EQ(has_commit, fs::exists(fs::path(source) / ".git")) << first_line;
}

TEST_F(Resume, OfAFinishedRunChangesNothing) {
  const fs::path place = workplace("finished");
  ASSERT_EQ(run(place, small_case_of_any_width(4)), exit_done);
  const auto written = fs::last_write_time(place / "run/comparison.svg");
  const auto history = content(place / "run/history.csv");
  EXPECT_EQ(resume(place), exit_done);
  EXPECT_EQ(fs::last_write_time(place / "run/comparison.svg"), written);
  EXPECT_EQ(content(place / "run/history.csv"), history);
}

// A run that converged continues when it is resumed with a smaller tolerance.
TEST_F(Resume, OfAConvergedRunNeedsASmallerTolerance) {
  const fs::path place = workplace("converged");
  ASSERT_EQ(run(place, small_case_of_any_width(4)), exit_done);
  const fs::path newest = CheckpointFolder(place / "run").files().front();
  const auto history = content(place / "run/history.csv");
  auto checkpoint = *parse_checkpoint_file<2>(content(newest));
  const auto resumed_after = [&](double tolerance) {
    checkpoint.finished = StopReason::converged;
    checkpoint.tolerance = tolerance;
    std::ofstream(newest, std::ios::binary) << checkpoint_file(checkpoint);
    EXPECT_EQ(resume(place, 6), exit_done);
    return content(place / "run/history.csv");
  };
  const double tolerance = checkpoint.tolerance;
  EXPECT_EQ(resumed_after(tolerance), history);
  EXPECT_NE(resumed_after(tolerance + 1e-3), history);
}

TEST_F(Resume, WritesResultsMissingAfterAKill) {
  const fs::path straight = workplace("straight"), killed = workplace("killed");
  ASSERT_EQ(run(straight, small_case_of_any_width(4)), exit_done);
  ASSERT_EQ(run(killed, small_case_of_any_width(4)), exit_done);
  const fs::path newest = CheckpointFolder(killed / "run").files().front();
  auto checkpoint = *parse_checkpoint_file<2>(content(newest));
  checkpoint.finished = {};
  std::ofstream(newest, std::ios::binary) << checkpoint_file(checkpoint);
  fs::remove(killed / "run/stress.svg");
  ASSERT_EQ(resume(killed), exit_done);
  expect_equal_results(straight / "run", killed / "run");
}

TEST_F(Resume, DropsRowsAndShapesAfterTheCheckpoint) {
  const fs::path place = workplace("behind");
  ASSERT_EQ(run(place, small_case_of_any_width(8)), exit_done);
  fs::remove(place / "run/checkpoints/shape_000008.checkpoint");
  ASSERT_NE(content(place / "run/shapes.pvd").find("shape_0007.vtu"), std::string::npos);
  std::ofstream(place / "run/STOP");
  EXPECT_EQ(resume(place), exit_terminated);
  EXPECT_EQ(split(split(content(place / "run/history.csv"), '\n').back(), ',').front(), "6");
  EXPECT_EQ(content(place / "run/shapes.pvd").find("shape_0007.vtu"), std::string::npos);
}

TEST_F(Resume, StartsIfThereIsNoCheckpointYet) {
  const fs::path straight = workplace("straight"), killed = workplace("killed");
  ASSERT_EQ(run(straight, small_case_of_any_width(3)), exit_done);
  fs::create_directories(killed / "run");
  for (const char* file : {"case.toml", list_of_written_files})
    fs::copy(straight / "run" / file, killed / "run" / file);
  std::ofstream(killed / "run/history.csv") << "half a li";
  ASSERT_EQ(resume(killed), exit_done);
  expect_equal_results(straight / "run", killed / "run");
}

TEST_F(Resume, AFileStopEndsTheRunAndIsRemoved) {
  const fs::path straight = workplace("straight"), stopped = workplace("stopped");
  ASSERT_EQ(run(straight, small_case_of_any_width(3)), exit_done);
  ASSERT_EQ(run(stopped, small_case_of_any_width(3), 1), exit_done);
  std::ofstream(stopped / "run/STOP");
  EXPECT_EQ(resume(stopped, 3), exit_terminated);
  EXPECT_FALSE(fs::exists(stopped / "run/STOP"));
  EXPECT_EQ(rows(stopped / "run"), 2);
  ASSERT_EQ(resume(stopped, 3), exit_done);
  expect_equal_results(straight / "run", stopped / "run");
}

TEST_F(Resume, ByTheClockSavesEveryShapeThatTakesLonger) {
  const auto with = [](int every, double seconds) {
    std::string text = small_case_of_any_width(5);
    text.replace(text.find("checkpoint_every = 3"), 20, fmt::format("checkpoint_every = {}", every));
    text.replace(text.find("checkpoint_seconds = 0"), 22, fmt::format("checkpoint_seconds = {}", seconds));
    return text;
  };
  const fs::path quick = workplace("quick"), slow = workplace("slow"), never = workplace("never");
  ASSERT_EQ(run(quick, with(0, 1e-6)), exit_done);
  ASSERT_EQ(run(slow, with(0, 1e6)), exit_done);
  ASSERT_EQ(run(never, with(0, 0)), exit_done);
  EXPECT_EQ(checkpoint_names(quick / "run"), (std::vector<std::string>{"shape_000005", "shape_000004"}));
  EXPECT_EQ(checkpoint_names(slow / "run"), (std::vector<std::string>{"shape_000005", "shape_000000"}));
  EXPECT_EQ(checkpoint_names(never / "run"), (std::vector<std::string>{"shape_000005", "shape_000000"}));
}

TEST_F(Resume, IsRefusedWhileAnotherRunHoldsTheFolder) {
  const fs::path place = workplace("locked");
  ASSERT_EQ(run(place, small_case_of_any_width(2)), exit_done);
  {
    const auto lock = FolderLock::acquire(place / "run");
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FolderLock::acquire(place / "run"));
    EXPECT_EQ(resume(place, 3), exit_refused);
    EXPECT_EQ(run(place, small_case_of_any_width(2)), exit_refused);
  }
  EXPECT_EQ(run(place, small_case_of_any_width(2)), exit_refused);
  EXPECT_EQ(resume(place, 3), exit_done);
}

}  // namespace
}  // namespace wheelwright::testing
