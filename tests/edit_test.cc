#include <cmath>
#include <numbers>

#include "tests/run_support.h"
#include "tests/takes_any_case.h"
#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/commands/edit_bounds.h"
#include "wheelwright/run/observers/command_log.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/contour.h"

// Commands that change the shape of a run, by exact areas and centres, and what is written of commands.

namespace wheelwright::testing {
namespace {

using TheRun = Run<2>;
using std::numbers::pi;

// A wheel without mirror symmetry: the holes stand at a phase of their own.
const std::string wheel = R"(
[wheel]
sectors = 5
[load]
positions = 2
[[holes.ring]]
count = 5
center_radius = 0.262
radius = 0.02
phase = 20
[grid]
radial_cells = 14
angular_cells = 130
tread_levels = 0
[optimizer]
rim_band = 0.01
tread_band = 0.02
iterations = 3
)";

constexpr double centre_radius = 0.262, radius = 0.02, phase = 20 * pi / 180;
const Point hole_centre = polar(centre_radius, phase);

Case the_case() { return *parse_case(wheel, "case.toml").value; }

LevelSet<2> full_ring(const Lattice<2>& lattice) {
  return {lattice, std::vector<double>(lattice.n_nodes(), -1)};
}

double area_of(const std::vector<Point>& corners) {
  return std::abs(signed_area({ContourKind::free, {corners.begin(), corners.end()}}));
}

TEST(Strokes, HoleRemovesItsDiscInEverySector) {
  const LevelSet<2> ring = full_ring(initial_shape<2>(the_case()).lattice);
  const double whole = material_measure(ring);
  const Point at = polar(0.27, 0.9);
  for (const double growth : {0.0, 0.005}) {
    const Stroke stroke{{Fill::hole, {circle_outline(Affine::shift(at), radius)}}, growth};
    const double r = radius + growth;
    EXPECT_NEAR(whole - material_measure(with_stroke(ring, stroke)), pi * r * r, 2e-3 * pi * r * r);
  }
}

TEST(Strokes, MaterialOverAHoleFillsItAndMoreChangesNothing) {
  const LevelSet<2> psi = initial_shape<2>(the_case());
  const Stroke disc{{Fill::material, {circle_outline(Affine::shift(hole_centre), 1.2 * radius)}}, 0};
  const LevelSet<2> filled = with_stroke(psi, disc);
  EXPECT_NEAR(material_measure(filled), material_measure(full_ring(psi.lattice)), 1e-12);
  EXPECT_EQ(with_stroke(filled, disc).values, filled.values);
  const Stroke elsewhere{{Fill::material, {circle_outline(Affine::shift(polar(0.23, 0.9)), 0.01)}}, 0};
  EXPECT_NEAR(material_measure(with_stroke(psi, elsewhere)), material_measure(psi), 1e-12);
}

TEST(HoleContours, AreFoundByAnyPointOfTheHoleInAnySector) {
  const LevelSet<2> psi = initial_shape<2>(the_case());
  for (const double turn : {0.0, 2 * pi / 5, 6 * pi / 5}) {
    const Point centre = Affine::rotation(turn).linear(hole_centre);
    for (const Point& offset : {Point{0, 0}, Point{0.018, 0}, Point{-0.01, 0.015}}) {
      const auto edge = hole_contour(psi, centre + offset);
      ASSERT_FALSE(edge.empty());
      EXPECT_NEAR(area_of(edge), pi * radius * radius, 3e-3 * pi * radius * radius);
      EXPECT_LT(norm<2>(centroid(edge) - centre), 1e-5);
    }
    EXPECT_TRUE(hole_contour(psi, centre + Point{0.022, 0}).empty());
  }
  EXPECT_TRUE(hole_contour(psi, {0, 0}).empty());
}

class EditTest : public TemporaryFolder {
 protected:
  struct Seen {
    std::vector<LevelSet<2>> shapes, proposed;
    std::vector<double> measures, objectives;
    std::vector<std::string> executed, refused;
  };

  class Watcher : public Observer<2> {
   public:
    explicit Watcher(Seen& seen) : seen_(seen) {}
    void operator()(const Event<2>& event, const RunView<2>&) override {
      if (const auto* command = std::get_if<CommandDone>(&event))
        (command->was_executed ? seen_.executed : seen_.refused).push_back(command->text);
      if (const auto* proposed = std::get_if<ShapeProposed<2>>(&event))
        seen_.proposed.push_back(proposed->shape);
      const auto* done = std::get_if<TrialDone<2>>(&event);
      if (!done || done->trial.verdict != Verdict::accepted) return;
      seen_.shapes.push_back(done->state.shape);
      seen_.measures.push_back(done->state.measure);
      seen_.objectives.push_back(done->state.evaluation.function("objective").value);
    }

   private:
    Seen& seen_;
  };

  /// What a paused run shows: its first shape, and then what each command made of it.
  Seen after(const std::vector<Command>& commands) {
    CommandQueue queue;
    queue.push(Pause{});
    for (const Command& command : commands) queue.push(command);
    queue.push(Stop{});
    auto run = TheRun::begin(the_case(), folder() / "run");
    EXPECT_TRUE(run);
    Seen seen;
    run->add(std::make_unique<Watcher>(seen));
    run->execute(queue);
    return seen;
  }
};

TEST_F(EditTest, MovedHoleKeepsItsSize) {
  const Point by{0.004, -0.006};
  const Seen seen = after({MoveHole{.at = hole_centre, .by = by}});
  ASSERT_EQ(seen.shapes.size(), 2U);
  const auto edge = hole_contour(seen.shapes[1], hole_centre + by);
  EXPECT_LT(norm<2>(centroid(edge) - (hole_centre + by)), 1e-4);
  const double hole =
      seen.shapes[0].lattice.grid().sector_angle() * (0.34 * 0.34 - 0.2 * 0.2) / 2 - seen.measures[0];
  EXPECT_NEAR(seen.measures[1], seen.measures[0], 0.01 * hole);
  EXPECT_NE(seen.objectives[1], seen.objectives[0]);
}

TEST_F(EditTest, ScaledHoleHasTheScaledArea) {
  const Seen seen = after({MoveHole{.at = hole_centre, .by = {}, .scale = 0.7}});
  ASSERT_EQ(seen.shapes.size(), 2U);
  const auto before = hole_contour(seen.shapes[0], hole_centre),
             now = hole_contour(seen.shapes[1], hole_centre);
  EXPECT_NEAR(area_of(now), 0.49 * area_of(before), 0.02 * area_of(before));
  EXPECT_LT(norm<2>(centroid(now) - centroid(before)), 2e-4);
}

TEST_F(EditTest, PaintedHolesAndUndoAndReset) {
  const Point at = polar(0.262, 0.95);
  const Paint hole{.as = Fill::hole, .path = {at}, .radius = 0.015};
  const Seen seen = after({hole, FillHole{at}, Undo{}, Undo{}, hole,
                           MoveHole{.at = hole_centre, .by = {0.003, 0}}, Reset{}, Undo{}});
  ASSERT_TRUE(seen.refused.empty()) << seen.refused.front();
  ASSERT_EQ(seen.shapes.size(), 9U);
  // A hole of three cells in radius is redistanced: its area keeps to a few percent of itself.
  const double disc = pi * 0.015 * 0.015;
  EXPECT_NEAR(seen.measures[0] - seen.measures[1], disc, 0.03 * disc);
  EXPECT_NEAR(seen.measures[2], seen.measures[0], 0.03 * disc);
  EXPECT_EQ(seen.shapes[3].values, seen.shapes[1].values);
  EXPECT_EQ(seen.objectives[3], seen.objectives[1]);
  EXPECT_EQ(seen.shapes[4].values, seen.shapes[0].values);
  EXPECT_EQ(seen.objectives[4], seen.objectives[0]);
  EXPECT_EQ(seen.shapes[5].values, seen.shapes[1].values);
  EXPECT_EQ(seen.shapes[7].values, seen.shapes[0].values);
  EXPECT_EQ(seen.objectives[7], seen.objectives[0]);
  EXPECT_EQ(seen.shapes[8].values, seen.shapes[6].values);
}

// Observers see a shape before it is solved, and the same one afterwards; a case that changes proposes none.
TEST_F(EditTest, ShapesAreProposedBeforeTheyAreSolved) {
  const Paint hole{.as = Fill::hole, .path = {polar(0.262, 0.95)}, .radius = 0.015};
  const Seen seen = after({hole, Reset{}, NewVolume{0.9}});
  ASSERT_EQ(seen.shapes.size(), 4U);
  ASSERT_EQ(seen.proposed.size(), 2U);
  EXPECT_EQ(seen.proposed[0].values, seen.shapes[1].values);
  EXPECT_EQ(seen.proposed[1].values, seen.shapes[2].values);
}

TEST_F(EditTest, ShapeOfAnotherRunIsExact) {
  const Paint hole{.as = Fill::hole, .path = {polar(0.262, 0.95)}, .radius = 0.015};
  const Seen other = after({hole});
  ASSERT_EQ(other.shapes.size(), 2U);
  LevelSet<2> of_other_wheel = other.shapes[1];
  PolarGrid<2> grid = of_other_wheel.lattice.grid();
  grid.outer_radius *= 1.01;
  of_other_wheel.lattice = Lattice<2>(grid, of_other_wheel.lattice.degree());
  const fs::path file = folder() / "shape", larger = folder() / "larger", damaged = folder() / "damaged";
  write_atomically(file, level_set_file(other.shapes[1]));
  write_atomically(larger, level_set_file(of_other_wheel));
  write_atomically(damaged, level_set_file(other.shapes[1]).substr(9));
  fs::remove_all(folder() / "run");
  const Seen seen =
      after({TakeShape{file.string()}, Undo{}, TakeShape{larger.string()}, TakeShape{damaged.string()},
             TakeShape{(folder() / "none").string()}, TakeShape{folder().string()}});
  EXPECT_EQ(seen.refused.size(), 4U);
  ASSERT_EQ(seen.shapes.size(), 3U);
  EXPECT_EQ(seen.shapes[1].values, other.shapes[1].values);
  EXPECT_EQ(seen.objectives[1], other.objectives[1]);
  EXPECT_EQ(seen.shapes[2].values, seen.shapes[0].values);
}

TEST_F(EditTest, TheSameShapeAgainIsNothingToUndo) {
  const Paint hole{.as = Fill::hole, .path = {polar(0.262, 0.95)}, .radius = 0.015};
  const Seen other = after({hole});
  ASSERT_EQ(other.shapes.size(), 2U);
  const fs::path file = folder() / "shape";
  write_atomically(file, level_set_file(other.shapes[1]));
  fs::remove_all(folder() / "run");
  const Seen seen = after({Reset{}, TakeShape{file.string()}, TakeShape{file.string()}, Undo{}, Undo{}});
  EXPECT_EQ(seen.refused.size(), 1U);  // the second Undo
  ASSERT_EQ(seen.shapes.size(), 5U);
  EXPECT_EQ(seen.shapes[3].values, other.shapes[1].values);
  EXPECT_EQ(seen.shapes[4].values, seen.shapes[0].values);
}

TEST_F(EditTest, InvalidWidthsAndBoundsAreRefused) {
  const Seen seen = after({NewWidths{.minimum_wall = 0.004, .minimum_gap = 0.003},
                           NewWidths{.minimum_wall = 10}, NewWidths{.minimum_gap = -1},
                           NewWidths{.minimum_radius = 10}, NewBound{.constraint = 0, .at_most = 1},
                           NewBound{.constraint = -1, .at_most = 1}, NewWidths{.minimum_wall = 0}});
  EXPECT_EQ(seen.refused.size(), 5U);
  ASSERT_EQ(seen.objectives.size(), 3U);
  EXPECT_EQ(seen.objectives[1], seen.objectives[0]);
}

TEST_F(EditTest, ImpossibleEditsAreRefusedWithoutEffect) {
  Paint cut{.as = Fill::hole, .path = {}, .radius = 0.012};  // all round the wheel
  for (int k = 0; k <= 40; ++k) cut.path.push_back(polar(0.265, 2 * pi / 5 * k / 40));
  const Seen seen = after({Undo{}, FillHole{polar(0.262, 0.95)}, MoveHole{.at = {}, .by = {}},
                           MoveHole{.at = hole_centre, .by = {}, .scale = -1}, Paint{}, cut});
  EXPECT_EQ(seen.refused.size(), 6U);
  EXPECT_EQ(seen.shapes.size(), 1U);
}

// What is so far off or so large that drawing it would not end.
TEST_F(EditTest, StrokesMustFitTheWheel) {
  const double far = 1e5, outer = the_case().wheel.outer_radius;
  const Point beside = polar(1.2 * outer, 1), opposite = polar(1.2 * outer, 3), on = polar(0.262, 0.95);
  const Seen seen = after(
      {Paint{.path = {on}, .radius = far}, Paint{.path = {{far, 0}}, .radius = 0.01},
       Paint{.path = {on, {0, -far}}, .radius = 0.01}, Paint{.path = {on}, .radius = 1.01 * outer},
       Paint{.path = {beside}, .radius = 0.19 * outer}, Paint{.path = {{0.01, 0}, {0, 0.02}}, .radius = 0.01},
       MoveHole{.at = hole_centre, .by = {far, 0}}, MoveHole{.at = {far, far}, .by = {}},
       MoveHole{.at = hole_centre, .by = {}, .scale = far},
       MoveHole{.at = hole_centre, .by = {}, .scale = 1 / far}, FillHole{.at = {far, 0}}});
  EXPECT_EQ(seen.refused.size(), 11U);
  EXPECT_EQ(seen.shapes.size(), 1U);
  EXPECT_FALSE(refused_line(the_case().wheel, std::vector<Point>{beside, opposite}, 0.001));  // goes across
}

TEST(EditBounds, NonFiniteStrokesAreRefused) {
  const double nan = std::nan(""), infinite = HUGE_VAL;
  for (const double bad : {nan, infinite, -infinite}) {
    EXPECT_TRUE(refused_line({}, std::vector<Point>{{0.26, 0}}, bad));
    EXPECT_TRUE(refused_line({}, std::vector<Point>{{0.26, 0}, {bad, 0}}, 0.01));
    EXPECT_TRUE(refused_hole({}, std::vector<Point>{{0.26, 0}, {0, bad}}));
  }
}

TEST_F(EditTest, UndoRestoresTheCase) {
  Load heavier = the_case().load;
  heavier.force *= 1.5;
  const Seen seen = after({NewLoad{heavier}, NewVolume{0.9}, Undo{}, Undo{}});
  ASSERT_EQ(seen.objectives.size(), 5U);
  EXPECT_GT(seen.objectives[1], 1.5 * seen.objectives[0]);
  EXPECT_EQ(seen.objectives[3], seen.objectives[1]);
  EXPECT_EQ(seen.objectives[4], seen.objectives[0]);
}

TEST_F(EditTest, UndoReportsWhatItUndid) {
  Load heavier = the_case().load;
  heavier.force *= 1.5;
  const Paint patch{.as = Fill::material, .path = {{hole_centre[0], hole_centre[1]}}, .radius = 0.01};
  const Seen seen = after({NewLoad{heavier}, patch, Reset{}, Undo{}, Undo{}, Undo{}});
  ASSERT_EQ(seen.executed.size(), 8U);  // the first pauses, the last stops
  for (int k = 1; k <= 3; ++k)
    EXPECT_TRUE(seen.executed[7 - k].ends_with(": " + seen.executed[k])) << seen.executed[7 - k];
}

/// A load of a wheel in 3D of which nothing is as by default.
Load load_with_everything() {
  Load load;
  load.force = 1234.5;
  load.travel = 0.1 + 0.2;
  load.horizontal_force = -12;
  load.lateral_force = 350;
  load.camber = 0.02;
  load.torque = 7;
  load.body_force = {1e-300, -1.0 / 3};
  load.hole_pressure = 900;
  load.speed = 11;
  load.positions = 5;
  return load;
}

/// What becomes of a case by a command that comes as JSON.
Expected<Case, Refusal> case_after(const Case& c, const std::string& json) {
  TakesAnyCase run(c);
  const auto command = parse_command(json);
  if (!command) return command.failure();
  const CommandResult executed = command->execute(run);
  if (!executed) return executed.failure();
  return run.current_case();
}

TEST(NewLoad, KeepsEveryKeyOfALoadIn3DThatItDoesNotChange) {
  Case c = the_case();
  c.wheel.dimension = 3;
  c.load = load_with_everything();
  Load heavier = c.load;
  heavier.force *= 1.1;
  const auto after = case_after(c, command_json(NewLoad{heavier}));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->load, heavier);
  heavier.speed = 3;
  EXPECT_EQ(case_after(c, command_json(NewLoad{heavier}))->load, heavier);
  EXPECT_EQ(load_json(heavier), load_json(case_after(c, command_json(NewLoad{heavier}))->load));
}

TEST(NewLoad, ChangesTheLoadCaseOfItsName) {
  Case c = the_case();
  c.load.torque = 3;
  c.load.cases = {{.name = "straight", .speed = 2}, {.name = "kerb", .travel = 0.001}};
  const auto loads = [](const Case& of) {
    std::vector<Load> result;
    for (const Case& single : single_load_cases(of)) result.push_back(single.load);
    return result;
  };
  const std::vector<Load> before = loads(c);
  Load load = load_with_everything();
  load.lateral_force = load.camber = 0;
  load.positions = c.load.positions;
  for (const bool has_travel : {true, false}) {
    if (!has_travel) load.travel.reset();
    for (const std::size_t k : {0, 1}) {
      const auto after = case_after(c, command_json(NewLoad{load, c.load.cases[k].name}));
      ASSERT_TRUE(after) << after.failure().reason;
      Load expected = load;
      if (has_travel) expected.force = before[k].force;  // is a result
      EXPECT_EQ(loads(*after)[k], expected);
      EXPECT_EQ(loads(*after)[1 - k], before[1 - k]);
    }
  }
  EXPECT_FALSE(case_after(c, command_json(NewLoad{load})));
  EXPECT_FALSE(case_after(c, command_json(NewLoad{load, "elsewhere"})));
  ++load.positions;
  EXPECT_FALSE(case_after(c, command_json(NewLoad{load, "kerb"})));
  EXPECT_FALSE(case_after(the_case(), command_json(NewLoad{load, "kerb"})));
}

TEST(CommandJson, EveryCommandReadsBackTheSame) {
  const Load load = load_with_everything();
  const std::vector<Command> commands{
      Save{},
      Stop{},
      Pause{},
      Continue{},
      Step{},
      Reset{},
      Undo{},
      NewWeights{.strain_energy = 0.1, .uniformity_dual = 1e5},
      NewLoad{load, "kerb"},
      NewVolume{2.0 / 3},
      NewWidths{.minimum_wall = 0.1 + 0.2, .minimum_gap = 0},
      NewBound{.constraint = 2, .at_least = -1.0 / 3, .at_most = 1e-300},
      TakeShape{"designs/\"003\"/shape.levelset"},
      Paint{.as = Fill::material, .path = {{0.1, -0.2}, {1.0 / 7, 0.3}}, .radius = 0.01},
      MoveHole{.at = {0.25, 1e-17}, .by = {-0.001, 0.002}, .scale = 0.9},
      FillHole{.at = {0.25, -0.01}}};
  EXPECT_EQ(commands.size(), commands_of_every_run().size());
  for (const Command& command : commands) {
    const std::string json = command_json(command);
    const auto back = parse_command(json);
    ASSERT_TRUE(back) << json;
    EXPECT_EQ(back->name(), command.name());
    EXPECT_EQ(command_json(*back), json);
  }
  const auto back = parse_command(command_json(NewLoad{load, "kerb"}));
  ASSERT_TRUE(back->is<NewLoad>());
  EXPECT_EQ(back->get_if<NewLoad>()->load, load);
  EXPECT_EQ(back->get_if<NewLoad>()->load_case, "kerb");
}

TEST(CommandJson, InvalidCommandsAreRefused) {
  for (const char* text :
       {"", "[]", "{", "null", "{\"do\":1}", "{\"do\":\"bogus\"}", "{\"do\":\"custom\"}",
        "{\"do\":\"pause\",\"x\":1}", "{\"do\":\"volume\"}", "{\"do\":\"volume\",\"target\":\"0.5\"}",
        "{\"do\":\"volume\",\"target\":1e999}", "{\"do\":\"volume\",\"target\":null}",
        "{\"do\":\"fill_hole\",\"at_m\":[1]}", "{\"do\":\"fill_hole\",\"at_m\":[1,2,3]}",
        "{\"do\":\"paint\",\"as\":\"air\",\"path_m\":[],\"radius_m\":1}", "[[[[[[[[[[[[[[[["})
    EXPECT_FALSE(parse_command(text)) << text;
  Paint longest{
      .as = Fill::hole, .path = std::vector<std::array<double, 2>>(max_path_points + 1), .radius = 1};
  EXPECT_FALSE(parse_command(command_json(longest)));
  longest.path.pop_back();
  EXPECT_TRUE(parse_command(command_json(longest)));
}

TEST(CommandLogs, AreReadUpToAnIncompleteLine) {
  const std::string lines =
      log_line({{3, 0}, Pause{}}) + log_line({{3, 1}, Continue{}}) + log_line({{9, 1}, NewVolume{0.5}});
  for (std::size_t size = 0; size <= lines.size(); ++size) {
    const auto log = parse_command_log(lines.substr(0, size));
    ASSERT_TRUE(log) << size;
    EXPECT_EQ(static_cast<long>(log->size()),
              std::count(lines.begin(), lines.begin() + static_cast<long>(size), '\n'));
  }
  EXPECT_EQ((*parse_command_log(lines)).back().moment, (Moment{9, 1}));
  EXPECT_FALSE(parse_command_log(log_line({{3, 1}, Pause{}}) + log_line({{3, 0}, Pause{}})));
  EXPECT_FALSE(parse_command_log("{\"trials\":-1,\"waits\":0,\"command\":{\"do\":\"pause\"}}\n"));
  EXPECT_FALSE(parse_command_log("no line\n"));
}

}  // namespace
}  // namespace wheelwright::testing
