#include <atomic>
#include <ctime>
#include <thread>
#include <utility>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/commands/command_reference.h"
#include "wheelwright/run/observers/command_log.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright::testing {
namespace {

using namespace std::chrono_literals;
using TheRun = Run<2>;  // a test has a Run() of its own

/// An observer of the test, in no list of the program: what stands in a file of its own otherwise. The one
/// line that makes it known to a run is the call of Run::add() in RunTest::execute() below; an observer of
/// every run would be named by one line in make_observers() (run/observers/observers.cc) instead.
class Recorder : public Observer<2> {
 public:
  struct Record {
    std::vector<int> accepted;       ///< iterations
    std::vector<double> objectives;  ///< of those
    std::vector<std::string> executed, refused, changes;
    std::vector<LevelSet<2>> shapes;
    int trials = 0, ended = 0;
    bool solutions_were_there = true;
  };
  using Reaction = std::function<void(const TrialDone<2>&)>;

  Recorder(Record& record, Reaction reaction) : record_(record), reaction_(std::move(reaction)) {}

  void operator()(const Event<2>& event, const RunView<2>&) override {
    if (const auto* command = std::get_if<CommandDone>(&event))
      (command->was_executed ? record_.executed : record_.refused).push_back(command->text);
    if (const auto* changed = std::get_if<CaseChanged>(&event)) record_.changes.push_back(changed->text);
    if (std::holds_alternative<RunEnded<2>>(event)) ++record_.ended;
    if (const auto* done = std::get_if<TrialDone<2>>(&event)) {
      ++record_.trials;
      record_.solutions_were_there =
          record_.solutions_were_there && (done->trial.solution || done->trial.failure);
      if (done->trial.verdict == Verdict::accepted) {
        record_.accepted.push_back(done->state.iteration);
        record_.objectives.push_back(done->state.evaluation.function("objective").value);
        record_.shapes.push_back(done->state.shape);
      }
      if (reaction_) reaction_(*done);
    }
  }

 private:
  Record& record_;
  Reaction reaction_;
};

class RunTest : public TemporaryFolder {
 protected:
  static Case the_case(const std::string& text) { return *parse_case(text, "case.toml").value; }
  static Case case_of(const fs::path& run) { return *read_case(run / "case.toml").value; }

  /// Executes a run; `reaction` sees every trial and may push commands.
  static RunResult<2> execute(Expected<TheRun, NotBegun<2>> run, CommandQueue& commands,
                              Recorder::Record& record, Recorder::Reaction reaction = {}) {
    EXPECT_TRUE(run);
    run->add(std::make_unique<Recorder>(record, std::move(reaction)));
    return run->execute(commands);
  }

  RunResult<2> straight(const std::string& text) {
    CommandQueue commands;
    Recorder::Record record;
    return execute(TheRun::begin(the_case(text), folder() / "straight"), commands, record);
  }
};

/// Pushes a command when this shape is accepted, not when it is evaluated again.
Recorder::Reaction after_shape(int shape, CommandQueue& commands, const Command& command) {
  return [shape, &commands, command](const TrialDone<2>& done) {
    const bool is_anew = done.state.iteration > 0 && done.trial.step == 0;
    if (done.trial.verdict == Verdict::accepted && done.state.iteration == shape && !is_anew)
      commands.push(command);
  };
}

TEST_F(RunTest, StopSavesAndResumeGivesTheSameBytes) {
  const std::string text = small_case(8);
  straight(text);
  for (int shape : {0, 3, 5}) {
    const fs::path stopped = folder() / std::to_string(shape);
    CommandQueue commands;
    Recorder::Record record;
    const auto result = execute(TheRun::begin(the_case(text), stopped), commands, record,
                                after_shape(shape, commands, Stop{}));
    EXPECT_EQ(result.reason, StopReason::stop_requested);
    EXPECT_EQ(result.state->iteration, shape);
    EXPECT_EQ(record.ended, 1);
    EXPECT_TRUE(record.solutions_were_there);
    CommandQueue none;
    const auto resumed = execute(TheRun::resume(case_of(stopped), stopped), none, record);
    EXPECT_EQ(resumed.reason, StopReason::iterations);
    expect_equal_results(folder() / "straight", stopped);
  }
}

/// Asks for a stop as soon as the last shape is saved, before the results are solved.
class StopBeforeTheResults : public Observer<2> {
 public:
  StopBeforeTheResults(int last_shape, CommandQueue& commands)
      : last_shape_(last_shape), commands_(commands) {}

  void operator()(const Event<2>& event, const RunView<2>&) override {
    const auto* save = std::get_if<SaveRequested<2>>(&event);
    if (save && save->state.iteration == last_shape_) commands_.push(Stop{});
  }

 private:
  int last_shape_;
  CommandQueue& commands_;
};

// They are on a finer tread than the loop's, and so have to be solved.
TEST_F(RunTest, InterruptedResultsAreCompletedByResume) {
  constexpr int last_shape = 2;
  std::string text = small_case(last_shape);
  const std::string own = "tread_levels = 0";
  text.replace(text.find(own), own.size(), "tread_levels = \"auto\"");
  straight(text);
  const fs::path stopped = folder() / "stopped";
  {
    CommandQueue commands;
    auto run = TheRun::begin(the_case(text), stopped);
    ASSERT_TRUE(run);
    run->add(std::make_unique<StopBeforeTheResults>(last_shape, commands));
    const auto result = run->execute(commands);
    EXPECT_EQ(result.reason, StopReason::stop_requested);
    EXPECT_EQ(result.state->iteration, last_shape);
  }
  CommandQueue none;
  Recorder::Record record;
  const auto resumed = execute(TheRun::resume(case_of(stopped), stopped), none, record);
  EXPECT_EQ(resumed.reason, StopReason::iterations);
  EXPECT_TRUE(resumed.summary);
  expect_equal_results(folder() / "straight", stopped);
}

// The stop comes while a shape is evaluated: the trial is forgotten.
TEST_F(RunTest, StopInterruptsAnEvaluation) {
  const std::string text = small_case(8);
  straight(text);
  const auto study = make_study<2>(the_case(text));
  ASSERT_TRUE(study);
  int of_start = 0;  // how often it is asked while the first shape is evaluated
  {
    int questions = 0;
    const Interrupt counting([&] {
      ++questions;
      return false;
    });
    optimize<2>(
        optimizer_of(*study, counting), study->initial,
        [&](const auto&, const auto&) { of_start = of_start == 0 ? questions : of_start; },
        [&] { return of_start > 0; });
  }
  ASSERT_GT(of_start, 1);
  for (int asked : {1, of_start, of_start + 1, of_start + 2, of_start + 7}) {
    int questions = 0;
    const Interrupt interrupt([&] { return ++questions >= asked; });
    const ShapeOptimizer<2> optimizer = optimizer_of(*study, interrupt);
    int trials = 0;
    const auto outcome = optimize<2>(
        optimizer, study->initial,
        [&](const Trial<2>& trial, const OptimizationState<2>&) {
          ++trials;
          EXPECT_FALSE(trial.failure && trial.failure->reason == FailureReason::interrupted);
        },
        [] { return false; });
    if (asked <= of_start) {
      EXPECT_EQ(outcome.failure->reason, FailureReason::interrupted);
      EXPECT_EQ(trials, 0);
      continue;
    }
    EXPECT_EQ(outcome.reason, StopReason::stop_requested);
    auto state = *outcome.state;
    const ShapeOptimizer<2> undisturbed = optimizer_of(*study);
    Outcome<2> whole = optimize<2>(
        undisturbed, study->initial, [](const auto&, const auto&) {}, [] { return false; });
    undisturbed.run(
        state, [](const auto&, const auto&) {}, [] { return false; });
    EXPECT_EQ(state.shape.values, whole.state->shape.values);
    EXPECT_EQ(state.history, whole.state->history);
  }
}

TEST_F(RunTest, StopFromAnotherThreadEndsItWithinTwoProcessorSeconds) {
  CommandQueue commands;
  Recorder::Record record;
  std::clock_t stopped_at{};
  std::atomic<bool> begun = false;
  std::thread user([&] {
    while (!begun) std::this_thread::sleep_for(1ms);
    stopped_at = std::clock();
    commands.push(Stop{});
  });
  const auto result = execute(TheRun::begin(the_case(small_case(10000)), folder() / "run"), commands, record,
                              [&](const TrialDone<2>&) { begun = true; });
  user.join();
  EXPECT_LT(double(std::clock() - stopped_at) / CLOCKS_PER_SEC, 2);
  EXPECT_EQ(result.reason, StopReason::stop_requested);
}

TEST_F(RunTest, SaveWritesACheckpointAndChangesNothing) {
  straight(small_case(8));
  CommandQueue commands;
  Recorder::Record record;
  const fs::path saved = folder() / "saved";
  bool was_there = false;
  execute(TheRun::begin(the_case(small_case(8)), saved), commands, record, [&](const TrialDone<2>& done) {
    if (done.trial.verdict == Verdict::accepted && done.state.iteration == 4) commands.push(Save{});
    if (done.state.iteration == 5) was_there = fs::exists(saved / "checkpoints/shape_000004.checkpoint");
  });
  EXPECT_TRUE(was_there);
  EXPECT_EQ(record.executed.size(), 1u);
  expect_equal_results(folder() / "straight", saved);
}

// Pause, three steps, continue: from another thread, which sees how far the run has come.
TEST_F(RunTest, PauseStepAndContinueGiveTheSameBytes) {
  straight(small_case(8));
  CommandQueue commands;
  Recorder::Record record;
  std::atomic<int> shape = -1;
  std::vector<int> seen;
  double processor_seconds_paused = 0;
  std::thread user([&] {
    const auto settled = [&] {  // longer than a shape takes
      int before = -2;
      while (shape < 2 || shape != before) {
        before = shape;
        std::this_thread::sleep_for(300ms);
      }
      return before;
    };
    seen.push_back(settled());
    for (int k = 0; k < 3; ++k) {
      commands.push(Step{});
      const int last = seen.back();
      while (shape == last) std::this_thread::sleep_for(1ms);
      seen.push_back(settled());
    }
    const auto processor = std::clock();
    std::this_thread::sleep_for(500ms);
    processor_seconds_paused = double(std::clock() - processor) / CLOCKS_PER_SEC;
    commands.push(Continue{});
  });
  const auto result = execute(TheRun::begin(the_case(small_case(8)), folder() / "paused"), commands, record,
                              [&](const TrialDone<2>& done) {
                                if (done.trial.verdict != Verdict::accepted) return;
                                if (done.state.iteration == 2) commands.push(Pause{});
                                shape = done.state.iteration;
                              });
  user.join();
  EXPECT_EQ(seen, (std::vector<int>{2, 3, 4, 5}));
  EXPECT_LT(processor_seconds_paused, 0.05);
  EXPECT_EQ(result.reason, StopReason::iterations);
  EXPECT_LT(result.elapsed_seconds, 60);
  expect_equal_results(folder() / "straight", folder() / "paused");
}

TEST_F(RunTest, StopsWhilePaused) {
  CommandQueue commands;
  Recorder::Record record;
  commands.push(Pause{});
  std::thread user([&] {
    std::this_thread::sleep_for(200ms);
    commands.push(Stop{});
  });
  const auto result = execute(TheRun::begin(the_case(small_case(8)), folder() / "run"), commands, record);
  user.join();
  EXPECT_EQ(result.reason, StopReason::stop_requested);
  EXPECT_EQ(result.state->iteration, 0);
}

TEST_F(RunTest, StepsThatWaitAddUp) {
  CommandQueue commands;
  Recorder::Record record;
  for (int k = 0; k < 3; ++k) commands.push(Step{});
  std::thread user([&] {
    while (record.accepted.size() < 4) std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(300ms);
    commands.push(Stop{});
  });
  const auto result = execute(TheRun::begin(the_case(small_case(8)), folder() / "run"), commands, record);
  user.join();
  EXPECT_EQ(result.state->iteration, 3);
}

/// The objective of a shape under a case.
double objective_under(const Case& c, const LevelSet<2>& shape) {
  const auto study = make_study<2>(c);
  EXPECT_TRUE(study);
  const auto evaluated = evaluate_of(*study)(shape, nullptr);
  EXPECT_TRUE(evaluated) << evaluated.failure().detail;
  return evaluated->evaluation.function("objective").value;
}

TEST_F(RunTest, NewLoadEqualsACaseWithThatLoad) {
  Case c = the_case(small_case(8));
  Load load = c.load;
  load.force *= 1.5;
  load.hole_pressure = 900;
  CommandQueue commands;
  Recorder::Record record;
  const fs::path run = folder() / "run";
  execute(TheRun::begin(c, run), commands, record, after_shape(4, commands, NewLoad{load}));
  ASSERT_EQ(record.accepted, (std::vector<int>{0, 1, 2, 3, 4, 4, 5, 6, 7, 8}));
  ASSERT_EQ(record.changes.size(), 1u);
  EXPECT_EQ(record.shapes[4].values, record.shapes[5].values);
  c.load = load;
  const double expected = objective_under(c, record.shapes[4]);
  EXPECT_NEAR(record.objectives[5], expected, 1e-12 * expected);
  EXPECT_NE(record.objectives[4], record.objectives[5]);
  EXPECT_EQ(case_of(run).load, load);
  const auto lines = split(content(run / "history.csv"), '\n');
  EXPECT_EQ(std::ranges::count_if(
                lines, [](const std::string& line) { return line.find("new load: ") != std::string::npos; }),
            1);
}

TEST_F(RunTest, ACaseThatChangedIsResumedWithTheSameBytes) {
  const Case c = the_case(small_case(9));
  Load load = c.load;
  load.force *= 0.8;
  const auto react = [&](CommandQueue& commands, int stop_after) {
    return [&, stop_after, last = -1](const TrialDone<2>& done) mutable {
      if (done.trial.verdict != Verdict::accepted) return;
      const bool is_anew = done.state.iteration == std::exchange(last, done.state.iteration);
      if (done.state.iteration == 4 && !is_anew) commands.push(NewLoad{load});
      if (done.state.iteration == stop_after && !is_anew) commands.push(Stop{});
    };
  };
  const fs::path straight = folder() / "changed";
  Recorder::Record record;
  CommandQueue commands;
  execute(TheRun::begin(c, straight), commands, record, react(commands, -1));
  for (int stop : {4, 5, 7}) {
    const fs::path stopped = folder() / std::to_string(stop);
    CommandQueue first, second;
    const auto result = execute(TheRun::begin(c, stopped), first, record, react(first, stop));
    EXPECT_EQ(result.reason, StopReason::stop_requested);
    EXPECT_EQ(result.state->iteration, stop);  // at 4 the stop waits behind the new load
    EXPECT_EQ(case_of(stopped).load, load);
    execute(TheRun::resume(case_of(stopped), stopped), second, record);
    expect_equal_results(straight, stopped);
  }
  EXPECT_TRUE(record.refused.empty());
}

/// The cells of history.csv below a name.
std::vector<std::string> column_of(const fs::path& run, const std::string& name) {
  const auto lines = split(content(run / "history.csv"), '\n');
  const auto header = split(lines.front(), ',');
  const auto place = std::ranges::find(header, name) - header.begin();
  EXPECT_LT(place, std::ssize(header)) << name;
  std::vector<std::string> cells;
  for (std::size_t k = 1; k < lines.size(); ++k) cells.push_back(split(lines[k], ',').at(place));
  return cells;
}

TEST_F(RunTest, NewWeightsMayAddAFunctional) {
  Case c = the_case(small_case(6));
  CommandQueue commands;
  Recorder::Record record;
  const fs::path run = folder() / "run";
  execute(TheRun::begin(c, run), commands, record,
          after_shape(3, commands, NewWeights{.strain_energy = 2.0, .uniformity_dual = 50.0}));
  ASSERT_EQ(record.accepted, (std::vector<int>{0, 1, 2, 3, 3, 4, 5, 6}));
  c.objective.strain_energy = 2;
  c.objective.uniformity_dual = 50;
  const double expected = objective_under(c, record.shapes[4]);
  EXPECT_NEAR(record.objectives[4], expected, 1e-12 * expected);
  EXPECT_EQ(case_of(run).objective, c.objective);
  const auto column = column_of(run, "uniformity_dual [J/m]");
  const auto energy = column_of(run, "strain_energy [J/m]"), objective = column_of(run, "objective [J/m]");
  const auto iteration = column_of(run, "iteration"), step = column_of(run, "step [m]");
  bool is_changed = false;  // from the row on in which shape 3 is evaluated again
  for (std::size_t row = 0; row < column.size(); ++row) {
    is_changed = is_changed || (iteration[row] == "3" && step[row] == "0");
    if (objective[row].empty()) continue;
    EXPECT_EQ(column[row].empty(), !is_changed) << row;
    const double weighted =
        is_changed ? 2 * std::stod(energy[row]) + 50 * std::stod(column[row]) : std::stod(energy[row]);
    EXPECT_NEAR(std::stod(objective[row]), weighted, 1e-12 * weighted) << row;
  }
  EXPECT_TRUE(is_changed);
}

// Also when the run ended between the new columns and the checkpoint behind them.
TEST_F(RunTest, ARunWithNewColumnsIsResumedWithTheSameBytes) {
  const Case c = the_case(small_case_of_any_width(6));
  const NewWeights weights{.strain_energy = 2.0, .uniformity_dual = 50.0};
  const auto execute_and_stop = [&](const fs::path& run, int stop) {
    CommandQueue commands;
    Recorder::Record record;
    execute(TheRun::begin(c, run), commands, record, [&](const TrialDone<2>& done) {
      if (done.trial.verdict != Verdict::accepted || done.trial.step == 0) return;
      if (done.state.iteration == 3) commands.push(weights);
      if (done.state.iteration == stop) commands.push(Stop{});
    });
  };
  const fs::path changed = folder() / "changed";
  execute_and_stop(changed, -1);
  fs::remove(changed / "history.csv.before");
  for (int stop : {3, 5}) {
    const fs::path stopped = folder() / std::to_string(stop);
    execute_and_stop(stopped, stop);
    CommandQueue none;
    Recorder::Record record;
    execute(TheRun::resume(case_of(stopped), stopped), none, record);
    fs::remove(stopped / "history.csv.before");  // holds times
    expect_equal_results(changed, stopped);
  }

  straight(small_case_of_any_width(6));
  const fs::path killed = folder() / "killed";
  execute_and_stop(killed, 3);
  fs::remove(CheckpointFolder(killed).files().front());  // that of the new case
  write_atomically(killed / "case.toml", content(folder() / "straight/case.toml"));
  CommandQueue none;
  Recorder::Record record;
  execute(TheRun::resume(c, killed), none, record);
  fs::remove(killed / "history.csv.before");
  expect_equal_results(folder() / "straight", killed);
}

TEST_F(RunTest, ARefusedCommandChangesNothing) {
  straight(small_case(6));
  const Case c = the_case(small_case(6));
  Load negative = c.load, none = c.load, twisting = c.load;
  negative.force = -1;
  none.positions = 0;
  twisting.torque = 5;  // without friction nothing would hold the wheel
  CommandQueue commands;
  Recorder::Record record;
  const fs::path run = folder() / "run";
  execute(TheRun::begin(c, run), commands, record, [&](const TrialDone<2>& done) {
    if (done.trial.verdict != Verdict::accepted || done.state.iteration != 3) return;
    commands.push(NewLoad{negative});
    commands.push(NewLoad{none});
    commands.push(NewLoad{twisting});
    commands.push(NewWeights{.strain_energy = 0.0});
    commands.push(NewWeights{.uniformity_dual = std::nan("")});
  });
  EXPECT_EQ(record.refused.size(), 5u);
  for (const std::string& reason : record.refused) EXPECT_FALSE(reason.empty());
  EXPECT_TRUE(record.executed.empty());
  EXPECT_TRUE(record.changes.empty());
  expect_equal_results(folder() / "straight", run);
}

/// A command of the test, in no list of the program: what stands in a file of its own otherwise. It is known
/// by one line, the one in with_postcards().
struct WritePostcard {
  static constexpr const char *name = "write_postcard", *meaning = "greets from a shape";
  std::string file;
  int first_shape = 0;

  CommandFields fields() {
    return {{"file", "", &file}, {"first_shape", "from which it is allowed", &first_shape}};
  }
  CommandResult execute(RunControl& run) const {
    if (run.iteration() < first_shape) return Refusal{"it is too early for a postcard"};
    std::ofstream(file) << "greetings from shape " << run.iteration();
    return std::string("wrote a postcard");
  }
};

CommandKinds with_postcards() {
  CommandKinds kinds = commands_of_every_run();
  kinds.push_back(command_kind<WritePostcard>());
  return kinds;
}

TEST_F(RunTest, OwnCommandIsExecutedLoggedAndReplayed) {
  const fs::path postcard = folder() / "postcard";
  {
    CommandQueue commands;
    Recorder::Record record;
    auto run = TheRun::begin(the_case(small_case(4)), folder() / "run");
    ASSERT_TRUE(run);
    run->add(std::make_unique<CommandLog<2>>());
    execute(std::move(run), commands, record, after_shape(2, commands, WritePostcard{postcard, 2}));
    EXPECT_EQ(content(postcard), "greetings from shape 2");
    EXPECT_EQ(record.executed.size(), 1u);
  }
  fs::remove(postcard);
  const std::string text = content(folder() / "run" / command_log_file);
  EXPECT_FALSE(parse_command_log(text));
  auto log = parse_command_log(text, with_postcards());
  ASSERT_TRUE(log);
  ASSERT_EQ(log->size(), 1u);
  auto replay = std::make_unique<CommandReplay<2>>(*std::move(log));
  CommandQueue commands;
  commands.add_source(replay->source());
  auto again = TheRun::begin(the_case(small_case(4)), folder() / "again");
  ASSERT_TRUE(again);
  again->add(std::make_unique<CommandLog<2>>());
  again->add(std::move(replay));
  Recorder::Record record;
  execute(std::move(again), commands, record);
  EXPECT_EQ(content(postcard), "greetings from shape 2");
  expect_equal_results(folder() / "run", folder() / "again");
}

TEST_F(RunTest, RefusedOwnCommandGivesItsReason) {
  CommandQueue commands;
  Recorder::Record record;
  const WritePostcard early{folder() / "postcard", 3};
  execute(TheRun::begin(the_case(small_case(4)), folder() / "run"), commands, record,
          after_shape(2, commands, early));
  EXPECT_EQ(record.refused, std::vector<std::string>{"it is too early for a postcard"});
  EXPECT_FALSE(fs::exists(early.file));
}

TEST(CommandReference, HasEveryCommandAndField) {
  const CommandKinds kinds = with_postcards();
  const std::string reference = command_reference_markdown(kinds);
  for (const CommandKind& kind : kinds) {
    EXPECT_NE(reference.find(fmt::format("## {}\n", kind.name)), std::string::npos) << kind.name;
    kind.make([&](const CommandFields& fields) {
      for (const CommandField& field : fields)
        EXPECT_NE(reference.find(fmt::format("| `{}` |", field.key)), std::string::npos) << field.key;
    });
  }
}

TEST(CommandQueue, KeepsTheOrderAndPollsItsSources) {
  CommandQueue queue;
  int asked = 0;
  queue.add_source([&]() -> std::optional<Command> {
    return ++asked == 1 ? std::optional<Command>(Save{}) : std::nullopt;
  });
  queue.push(Pause{});
  queue.push(Stop{});
  EXPECT_EQ(queue.waiting_stops(), 1);
  EXPECT_TRUE(queue.take()->is<Pause>());
  EXPECT_TRUE(queue.wait().is<Stop>());
  EXPECT_EQ(queue.waiting_stops(), 0);
  EXPECT_TRUE(queue.take()->is<Save>());
  EXPECT_FALSE(queue.take());
}

// However short ago the others were asked: a stop that waits when a run begins is known from the beginning.
TEST(CommandQueue, NewSourceIsPolledAtOnce) {
  CommandQueue queue;
  EXPECT_EQ(queue.waiting_stops(), 0);
  for (int stops = 1; stops <= 2; ++stops) {
    queue.add_source([is_asked = false]() mutable -> std::optional<Command> {
      return std::exchange(is_asked, true) ? std::nullopt : std::optional<Command>(Stop{});
    });
    EXPECT_EQ(queue.waiting_stops(), stops);
  }
}

TEST(CommandQueue, LosesNothingBetweenThreads) {
  CommandQueue queue;
  constexpr int each = 200;
  std::vector<std::thread> users;
  for (int t = 0; t < 3; ++t)
    users.emplace_back([&] {
      for (int k = 0; k < each; ++k) queue.push(Step{});
    });
  for (int k = 0; k < 3 * each; ++k) EXPECT_TRUE(queue.wait().is<Step>());
  for (auto& user : users) user.join();
  EXPECT_FALSE(queue.take());
}

}  // namespace
}  // namespace wheelwright::testing
