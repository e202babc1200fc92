#include <algorithm>
#include <cmath>

#include "tests/fuzz/target.h"
#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/observers/command_log.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

/// What a page sends.
void try_command(std::string_view text) {
  const auto command = parse_command(text);
  if (!command) return require(!command.failure().reason.empty(), "a refusal has a reason");
  const std::string written = command_json(*command);
  require(written.find('\n') == std::string::npos, "a command is one line");
  const auto again = parse_command(written);
  require(again && command_json(*again) == written, "what is written is read as the same command");
}

/// A run of which commands see and change nothing but a shape that is never solved.
class ShapeOnly : public RunControl {
 public:
  const Case& current_case() const override { return case_; }
  int iteration() const override { return 0; }
  void save() override {}
  void stop() override {}
  std::optional<Refusal> pause(int) override { return {}; }
  std::optional<Refusal> continue_run() override { return {}; }
  std::optional<Refusal> change_case(const Case&, const std::string&) override { return {}; }
  std::vector<Point> hole_at(const Point& point) const override { return hole_contour(shape_, point); }
  std::optional<Refusal> draw(std::span<const Stroke> strokes, const std::string&) override {
    for (const Stroke& stroke : strokes) shape_ = with_stroke(shape_, stroke);
    require(std::ranges::all_of(shape_.values, [](double v) { return std::isfinite(v); }),
            "what is drawn leaves a shape");
    return {};
  }
  std::optional<Refusal> take_shape(const std::filesystem::path&, const std::string&) override { return {}; }
  std::optional<Refusal> reset() override { return {}; }
  Expected<std::string, Refusal> undo() override { return std::string("the last change"); }

 private:
  static LevelSet<2> ring_with_holes(const Wheel& wheel) {
    const PolarGrid<2> grid{wheel.inner_radius, wheel.outer_radius, wheel.width, wheel.sectors, {7, 6}};
    const Lattice<2> lattice(grid, 1);
    const LevelSet<2> ring{lattice, std::vector<double>(lattice.n_nodes(), -1)};
    return with_stroke(ring, {{Fill::hole, {circle_outline(Affine::shift({0.265, 0}), 0.03)}}, 0});
  }

  Case case_;
  LevelSet<2> shape_ = ring_with_holes(case_.wheel);
};

/// What a run makes of it.
void try_edit(std::string_view text) {
  const auto command = parse_command(text);
  if (!command) return;
  ShapeOnly run;
  const auto executed = command->execute(run);
  require(executed || !executed.failure().reason.empty(), "a refusal has a reason");
}

/// What a replay reads.
void try_log(std::string_view text) {
  const auto log = parse_command_log(text);
  if (!log) return require(!log.failure().reason.empty(), "a refusal has a reason");
  std::string written;
  for (const LoggedCommand& logged : *log) written += log_line(logged);
  const auto again = parse_command_log(written);
  require(again && again->size() == log->size(), "what is written is read as the same log");
}

}  // namespace

namespace {

/// Sets every field, also optional ones.
struct FillIn {
  void operator()(double* place) const { *place = 0.26; }
  void operator()(int* place) const { *place = 1; }
  void operator()(std::string* place) const { *place = "kerb"; }
  void operator()(Fill* place) const { *place = Fill::material; }
  void operator()(std::array<double, 2>* place) const { *place = {0.26, 0}; }
  void operator()(std::vector<std::array<double, 2>>* place) const { *place = {{0.26, 0}, {0.27, 0.01}}; }
  template <class T>
  void operator()(std::optional<T>* place) const {
    (*this)(&place->emplace());
  }
};

/// Every kind of command, with its default values and with all of its fields.
std::vector<Command> commands_of_every_kind() {
  std::vector<Command> commands;
  for (const CommandKind& kind : commands_of_every_run()) {
    commands.push_back(kind.make([](const CommandFields&) {}));
    commands.push_back(kind.make([](const CommandFields& fields) {
      for (const CommandField& field : fields) std::visit(FillIn(), field.place);
    }));
  }
  return commands;
}

}  // namespace

std::vector<std::string> wheelwright::testing::seeds() {
  std::vector<Command> commands = commands_of_every_kind();
  const std::vector<Command> edges = {Paint{.path = {{0.26, 0}, {1e5, 0}}, .radius = 0.01},
                                      Paint{.path = {{0.26, 0}}, .radius = 1e5},
                                      Paint{.path = {{0.3, 0.3}, {-0.3, -0.3}}, .radius = 1e-9},
                                      MoveHole{.at = {0.26, 0}, .by = {0, 0.01}, .scale = 1.1},
                                      MoveHole{.at = {0.265, 0}, .by = {1e5, 0}, .scale = 1.1},
                                      MoveHole{.at = {0.265, 0}, .by = {0.01, 0}, .scale = 1e-2}};
  commands.insert(commands.end(), edges.begin(), edges.end());
  std::vector<std::string> seeds;
  std::string log;
  for (const Command& command : commands) {
    seeds.push_back(command_json(command));
    log += log_line({{static_cast<int>(seeds.size()), 1}, command});
  }
  seeds.push_back(log);
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try_command(text);
  try_edit(text);
  try_log(text);
  return 0;
}
