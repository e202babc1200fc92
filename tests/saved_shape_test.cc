#include <sys/wait.h>

#include <numbers>

#include "tests/run_support.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/shape/cut/measure.h"

// Runs that begin with the shape of an earlier run, and runs that begin on coarser grids.

namespace wheelwright::testing {
namespace {

using std::numbers::pi;

/// A wheel without mirror symmetry, in 4 sectors.
const std::string uneven_wheel = R"(
[wheel]
sectors = 4
[load]
positions = 3
)";
const std::string uneven_holes = R"(
[[holes.circle]]
center = [0.245, 0.06]
radius = 0.022
[[holes.circle]]
center = [0.17, 0.22]
radius = 0.03
)";
const std::string small_grid = R"(
[grid]
radial_cells = 14
angular_cells = 128
tread_levels = 0
)";

std::string optimizer(int iterations, const std::string& more = "") {
  return fmt::format(
      "\n[optimizer]\niterations = {}\nrim_band = 0.0125\ntread_band = 0.025\n{}\n[output]\nvtu_every = 0\n",
      iterations, more);
}

class SavedShape : public TemporaryFolder {
 protected:
  Case read(const std::string& text) {
    const fs::path file = folder() / "case.toml";
    std::ofstream(file) << text;
    CaseResult result = read_case(file);
    for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
    return result.value.value_or(Case{});
  }

  /// The problem of a case that begins with the shape "from".
  std::string problem(const std::string& from, const std::string& wheel, const std::string& more = "") {
    const fs::path file = folder() / "bad.toml";
    std::ofstream(file) << wheel + "\n[shape]\nfrom = \"" + from + "\"\n" + more + small_grid + optimizer(1);
    const CaseResult result = read_case(file);
    EXPECT_FALSE(result.value);
    EXPECT_EQ(result.problems.size(), 1u);
    return result.problems.empty() ? "" : result.problems.front().text();
  }

  template <int dim = 2>
  RunResult<dim> run(const Case& c, const std::string& name) {
    auto run = wheelwright::Run<dim>::begin(c, folder() / name);
    if (!run) throw std::runtime_error("the run does not begin");
    CommandQueue commands;
    return run->execute(commands);
  }
};

TEST_F(SavedShape, IsTheSameOnTheSameGrid) {
  const auto first = run(read(uneven_wheel + uneven_holes + small_grid + optimizer(4)), "first");
  const std::string from = uneven_wheel + "[shape]\nfrom = \"first\"\n" + small_grid;
  const Case again = read(from + optimizer(3));
  EXPECT_EQ(initial_shape<2>(again).values, first.state->shape.values);
  const auto change = volume_change_of_saved_shape<2>(again);
  EXPECT_DOUBLE_EQ(change->there, change->here);

  const auto second = run(read(from + optimizer(0)), "second");
  EXPECT_EQ(content(folder() / "first" / saved_shape_file), content(folder() / "second" / saved_shape_file));
  const double before = first.state->evaluation.function("objective").value;
  EXPECT_EQ(second.state->evaluation.function("objective").value, before);
}

TEST_F(SavedShape, RunStartsFromTheLastShapeOfAnother) {
  const fs::path first = folder() / "first", second = folder() / "second";
  run(read(uneven_wheel + uneven_holes + small_grid + optimizer(3)), "first");
  const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  const auto code = [&](const std::string& arguments) {
    return WEXITSTATUS(std::system(
        fmt::format("cd '{}' && '{}' run {} >out.txt 2>&1", folder().string(), program.string(), arguments)
            .c_str()));
  };
  ASSERT_EQ(code("first --output second --iterations 0"), 0) << content(folder() / "out.txt");
  EXPECT_EQ(content(first / saved_shape_file), content(second / saved_shape_file));
  EXPECT_EQ(code("first"), 2);  // where to?
  EXPECT_EQ(code("first/shape.levelset --output third"), 2);
  EXPECT_NE(content(folder() / "out.txt").find("no load"), std::string::npos);
  fs::remove(first / saved_shape_file);
  EXPECT_EQ(code("first --output third"), 2);
  EXPECT_FALSE(fs::exists(folder() / "third"));
}

TEST_F(SavedShape, IsCopiedToTheFolderOfTheNewRun) {
  run(read(uneven_wheel + uneven_holes + small_grid + optimizer(1)), "first");
  const Case c = read(uneven_wheel + "[shape]\nfrom = \"first\"\n" + small_grid + optimizer(1));
  run(c, "second");
  fs::remove_all(folder() / "first");
  const CaseResult own = read_case(folder() / "second" / "case.toml");
  ASSERT_TRUE(own.value);
  EXPECT_EQ(initial_shape<2>(*own.value).values, initial_shape<2>(c).values);
  EXPECT_FALSE(own.value->saved_shape.checksum.empty());
  EXPECT_EQ(*parse_case(to_toml(*own.value), folder() / "second" / "case.toml").value, *own.value);

  // Another file in its place is told from it.
  LevelSet<2> other = initial_shape<2>(c);
  other.values[0] += 1e-3;
  std::ofstream(folder() / "second" / own.value->saved_shape.from, std::ios::binary) << level_set_file(other);
  const CaseResult changed = read_case(folder() / "second" / "case.toml");
  ASSERT_EQ(changed.problems.size(), 1u);
  EXPECT_EQ(changed.problems[0].key, "shape.checksum");
}

TEST_F(SavedShape, OnAnotherGridDiffersOnlyByTheGrids) {
  const auto objective_on = [&](const std::string& shape, const std::string& grid, const std::string& name) {
    return run(read(uneven_wheel + shape + grid + optimizer(0)), name)
        .state->evaluation.function("objective")
        .value;
  };
  const std::string finer = "[grid]\nradial_cells = 18\nangular_cells = 176\ntread_levels = 0\n";
  const double there = objective_on(uneven_holes, small_grid, "there"),
               here = objective_on(uneven_holes, finer, "here");
  const double moved = objective_on("[shape]\nfrom = \"there\"\n", finer, "moved");
  const double grids = std::abs(here - there) / here;
  EXPECT_GT(grids, 1e-4);
  EXPECT_LT(std::abs(moved - here) / here, grids);
  const Case c = read(uneven_wheel + "[shape]\nfrom = \"there\"\n" + finer + optimizer(0));
  const auto change = volume_change_of_saved_shape<2>(c);
  EXPECT_NE(change->there, change->here);
  EXPECT_NEAR(change->there, change->here, 1e-3);
}

/// The area that two circles share, whose centres are `apart`.
double shared_area(double apart, double r, double s) {
  if (apart + std::min(r, s) <= std::max(r, s)) return pi * std::min(r * r, s * s);
  const double a = std::acos((apart * apart + r * r - s * s) / (2 * apart * r)),
               b = std::acos((apart * apart + s * s - r * r) / (2 * apart * s));
  return r * r * (a - 0.5 * std::sin(2 * a)) + s * s * (b - 0.5 * std::sin(2 * b));
}

TEST_F(SavedShape, IsCutOffAtTheBands) {
  run(read(uneven_wheel + uneven_holes + small_grid + optimizer(0)), "first");
  // Bands on lines of the grid, whose cells are 10 mm, in the middle of cells, and anywhere.
  for (const auto& [rim, tread] : {std::pair{0.035, 0.04}, {0.04, 0.0425}, {0.0371, 0.0483}}) {
    SCOPED_TRACE(rim);
    const Case c = read(uneven_wheel + "[shape]\nfrom = \"first\"\n" + small_grid +
                        fmt::format("[optimizer]\nrim_band = {}\ntread_band = {}\n", rim, tread));
    const LevelSet<2> shape = initial_shape<2>(c);
    for (int i = 0; i < shape.lattice.n_nodes(); ++i) {
      const double r = shape.lattice.polar_point(i)[0];
      if (r < 0.2 + rim - 1e-4 || r > 0.34 - tread + 1e-4) {
        EXPECT_LE(shape.values[i], 0);
      }
    }
    // The segments of the two holes beyond the bands become material again.
    const double inner_hole = shared_area(std::hypot(0.245, 0.06), 0.022, 0.2 + rim),
                 outer_hole = pi * 0.03 * 0.03 - shared_area(std::hypot(0.17, 0.22), 0.03, 0.34 - tread);
    const double more = (inner_hole + outer_hole) / (pi / 4 * (0.34 * 0.34 - 0.2 * 0.2));
    const auto change = volume_change_of_saved_shape<2>(c);
    EXPECT_GT(more, 4e-3);
    EXPECT_NEAR(change->here - change->there, more, 0.05 * more);
  }
}

TEST_F(SavedShape, MisfitIsRefusedWithItsPlace) {
  run(read(uneven_wheel + uneven_holes + small_grid + optimizer(0)), "first");
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(problem("nowhere", uneven_wheel), "there is no file");
  fs::create_directory(folder() / "empty");
  expect(problem("empty", uneven_wheel), "contains no saved shape");
  expect(problem("case.toml", uneven_wheel), "wrong_kind");
  expect(problem("first", "[wheel]\nsectors = 8\n"), "one of 1, 2, 4");
  expect(problem("first", "[wheel]\nsectors = 4\nouter_radius = 0.35\n"), "wheel.outer_radius = 0.34");
  expect(problem("first", uneven_wheel + uneven_holes), "cannot be drawn over");
  expect(problem("first", uneven_wheel, "[[shape.circle]]\ncount = 4\ncenter_radius = 0.27\nradius = 0.02\n"),
         "cannot be drawn over");
  const LevelSet<3> solid{Lattice<3>({0.2, 0.34, 0.12, 4, {2, 4, 1}}, 1),
                          std::vector<double>(3 * 4 * 2, -1.0)};
  std::ofstream(folder() / "solid", std::ios::binary) << level_set_file(solid);
  expect(problem("solid", uneven_wheel), "3D shape");
  const std::string thin = "[wheel]\nsectors = 2\ndimension = 3\nwidth = 0.05\n[load]\npositions = 1\n";
  expect(problem("solid", thin), "wheel.width = 0.12");
  std::string bytes = content(folder() / "first" / saved_shape_file);
  bytes[bytes.size() / 2] ^= 4;
  std::ofstream(folder() / "damaged", std::ios::binary) << bytes;
  expect(problem("damaged", uneven_wheel), "wrong_checksum");
}

/// Stops the run after its n-th accepted shape, moves between grids included.
class StopAfter : public Observer<2> {
 public:
  StopAfter(CommandQueue& commands, int n) : commands_(commands), left_(n) {}
  void operator()(const Event<2>& event, const RunView<2>&) override {
    const auto* done = std::get_if<TrialDone<2>>(&event);
    if (done && done->trial.verdict == Verdict::accepted && --left_ == 0) commands_.push(Stop{});
  }

 private:
  CommandQueue& commands_;
  int left_;
};

const std::string solid_wheel = R"(
[wheel]
sectors = 12
dimension = 3
[load]
positions = 1
)";
const std::string solid_grid = R"(
[grid]
radial_cells = 7
angular_cells = 48
axial_cells = 2
degree = 1
[material]
poissons_ratio = 0.3
)";
const std::string solid_bands = "[optimizer]\nrim_band = 0.0201\ntread_band = 0.0405\n";

TEST_F(SavedShape, InThreeDimensionsIsTheSameOnTheSameGrid) {
  const std::string sphere = "[[holes.sphere]]\ncount = 12\ncenter_radius = 0.26\nradius = 0.03\nz = 0.02\n";
  const Case drawn = read(solid_wheel + sphere + solid_grid + solid_bands + "iterations = 0\n");
  const auto first = run<3>(drawn, "first");
  const Case again =
      read(solid_wheel + "[shape]\nfrom = \"first\"\n" + solid_grid + solid_bands + "iterations = 0\n");
  EXPECT_EQ(initial_shape<3>(again).values, first.state->shape.values);
  const auto second = run<3>(again, "second");
  EXPECT_EQ(second.state->evaluation.function("objective").value,
            first.state->evaluation.function("objective").value);
  EXPECT_EQ(content(folder() / "first" / saved_shape_file), content(folder() / "second" / saved_shape_file));
}

TEST_F(SavedShape, OfAWheelInThePlaneIsExtruded) {
  const std::string plane_wheel = "[wheel]\nsectors = 12\n[load]\npositions = 1\n",
                    hole = "[[holes.ring]]\ncount = 12\ncenter_radius = 0.26\nradius = 0.03\n",
                    plane_grid = "[grid]\nradial_cells = 7\nangular_cells = 48\ntread_levels = 0\n";
  const auto plane = run(read(plane_wheel + hole + plane_grid + solid_bands + "iterations = 0\n"), "plane");
  const Case c =
      read(solid_wheel + "[shape]\nfrom = \"plane\"\n" + solid_grid + solid_bands + "iterations = 0\n");
  const LevelSet<3> shape = initial_shape<3>(c);
  const LevelSet<2> section = initial_shape<2>(
      read(plane_wheel + "[shape]\nfrom = \"plane\"\n" + plane_grid + solid_bands + "iterations = 0\n"));
  for (int node = 0; node < shape.lattice.n_nodes(); ++node) {
    const auto p = shape.lattice.node_position(node);
    EXPECT_EQ(shape.values[node], section.values[section.lattice.node_index({p[0], p[1]})]);
  }
  EXPECT_NEAR(material_measure(shape), 0.12 * material_measure(section), 1e-9);
  const double ring = 0.5 * 2 * pi / 12 * (0.34 * 0.34 - 0.2 * 0.2);
  const auto change = volume_change_of_saved_shape<3>(c);
  EXPECT_NEAR(change->there * ring, plane.initial->measure, 1e-9);
  EXPECT_NEAR(change->here * ring * 0.12, material_measure(shape), 1e-9);
}

class CoarseLevels : public SavedShape {};

TEST_F(CoarseLevels, EndOnTheCasesGridAndRecordTheGrids) {
  const Case c = read(uneven_wheel + uneven_holes + small_grid + optimizer(60, "coarse_levels = 1"));
  const auto result = run(c, "run");
  EXPECT_EQ(level_of(c, result.state->shape), 0);
  EXPECT_NEAR(result.state->measure, result.initial->measure, 2e-6 * result.initial->measure);
  EXPECT_EQ(level_of(c, result.initial->shape), 0);
  const std::string history = content(folder() / "run" / "history.csv");
  const auto coarse = history.find("grid 7 x 64"), own = history.find("grid 14 x 128");
  ASSERT_NE(coarse, std::string::npos);
  ASSERT_NE(own, std::string::npos);
  EXPECT_LT(coarse, own);

  Case direct = c;
  direct.optimizer.coarse_levels = 0;
  const auto without = run(direct, "direct");
  EXPECT_NEAR(result.state->evaluation.function("objective").value,
              without.state->evaluation.function("objective").value,
              0.01 * without.state->evaluation.function("objective").value);
}

TEST_F(CoarseLevels, StoppedRunContinuesIdenticallyFromEitherGrid) {
  const Case c = read(uneven_wheel + uneven_holes + small_grid + optimizer(16, "coarse_levels = 1"));
  run(c, "straight");
  const int n_rows = static_cast<int>(split(content(folder() / "straight" / "history.csv"), '\n').size());
  ASSERT_GT(n_rows, 8);
  for (const int n : {1, 2, 4, 13, 16}) {
    const std::string name = "stopped";
    {
      auto stopped = wheelwright::Run<2>::begin(c, folder() / name);
      ASSERT_TRUE(stopped);
      CommandQueue commands;
      stopped->add(std::make_unique<StopAfter>(commands, n));
      const auto result = stopped->execute(commands);
      ASSERT_EQ(result.reason, StopReason::stop_requested) << n;
      EXPECT_TRUE(result.summary);
    }
    auto resumed = wheelwright::Run<2>::resume(c, folder() / name);
    ASSERT_TRUE(resumed);
    CommandQueue commands;
    resumed->execute(commands);
    SCOPED_TRACE(n);
    expect_equal_results(folder() / "straight", folder() / name);
    fs::remove_all(folder() / name);
  }
}

/// Notes the stages that a run leaves out.
class FailedStages : public Observer<2> {
 public:
  explicit FailedStages(std::vector<StageFailed>& seen) : seen_(seen) {}
  void operator()(const Event<2>& event, const RunView<2>&) override {
    if (const auto* failed = std::get_if<StageFailed>(&event)) seen_.push_back(*failed);
  }

 private:
  std::vector<StageFailed>& seen_;
};

// The walls between the holes are thinner than a coarse cell.
TEST_F(CoarseLevels, GridThatFailsIsReportedAndLeftOut) {
  const std::string wheel = "[wheel]\nsectors = 8\n[load]\npositions = 1\n";
  const std::string holes = "[[holes.ring]]\ncount = 16\ncenter_radius = 0.266\nradius = 0.05\n";
  const std::string optimizer =
      "[optimizer]\niterations = 2\nrim_band = 0.0125\ntread_band = 0.02\ncoarse_levels = ";
  auto begun =
      wheelwright::Run<2>::begin(read(wheel + holes + small_grid + optimizer + "1"), folder() / "run");
  ASSERT_TRUE(begun);
  std::vector<StageFailed> failed;
  begun->add(std::make_unique<FailedStages>(failed));
  CommandQueue commands;
  const auto result = begun->execute(commands);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_NE(failed[0].stage.find("7 x 64"), std::string::npos) << failed[0].stage;
  EXPECT_FALSE(failed[0].reason.empty());
  const auto direct = run(read(wheel + holes + small_grid + optimizer + "0"), "direct");
  EXPECT_EQ(result.state->iteration, 2);
  EXPECT_EQ(result.state->shape.values, direct.state->shape.values);
}

TEST_F(CoarseLevels, KeepSizesGivenInMetres) {
  const Case c = read(uneven_wheel + uneven_holes +
                      "[grid]\nradial_cells = 56\nangular_cells = 512\n[objective]\nuniformity_annulus = 1\n"
                      "annulus = 0.01\nlength = 0.02\n");
  const Case coarse = on_coarser_grid(c, 2);
  EXPECT_EQ(coarse.grid.radial_cells, 14);
  EXPECT_EQ(coarse.grid.angular_cells, 128);
  EXPECT_EQ(coarse.objective.annulus, 0.01);
  EXPECT_EQ(coarse.objective.length, 0.02);
  EXPECT_GE(*coarse.optimizer.rim_band, 0.01 - 1e-12);    // one row of coarse cells
  EXPECT_GE(*coarse.optimizer.tread_band, 0.02 - 1e-12);  // the annulus and one more
  EXPECT_EQ(on_coarser_grid(c, 0), c);
  EXPECT_TRUE(can_be_halved(c, 3));
  EXPECT_FALSE(can_be_halved(c, 4));
}

TEST_F(CoarseLevels, GridsThatCannotBeHalvedAreRefused) {
  const auto problem = [&](const std::string& more) {
    const CaseResult result = parse_case(uneven_wheel + uneven_holes + more, "case.toml");
    return result.problems.size() == 1 ? result.problems[0].text() : "";
  };
  EXPECT_NE(problem("[grid]\nradial_cells = 30\nangular_cells = 384\n[optimizer]\ncoarse_levels = 2\n")
                .find("use 1"),
            std::string::npos);
  EXPECT_NE(problem("[objective]\nuniformity_annulus = 1\n[optimizer]\ncoarse_levels = 1\n").find("annulus"),
            std::string::npos);
}

}  // namespace
}  // namespace wheelwright::testing
