#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/checkpoints/checkpoint_folder.h"

// The program as its users and their machines treat it: killed, stopped, out of disk.

namespace wheelwright::testing {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

fs::path folder_of_programs() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// What is different about one call of the program.
struct Surroundings {
  std::string fault = {};            ///< for the library fault_injection
  rlim_t file_size = RLIM_INFINITY;  ///< largest file that it may write [bytes]
  std::string threads = "1";         ///< that the environment wants
  std::string messages = {};         ///< instead of "printed", where standard error goes
  std::string terminal = {};         ///< that it runs on, and prints to
  std::string computations = {};     ///< file for the library computation_log
};

/// A terminal without a window: what is printed to it is lost.
class Terminal {
 public:
  Terminal() : end_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (grantpt(end_) == 0 && unlockpt(end_) == 0) path_ = ptsname(end_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() { close(); }

  const std::string& path() const { return path_; }
  void close() {
    if (end_ >= 0) ::close(end_);
    end_ = -1;
  }

 private:
  int end_;
  std::string path_;
};

/// The program, running in a folder. What it prints goes to the file "printed" there.
class Program {
 public:
  Program(const fs::path& where, const std::vector<std::string>& arguments,
          const Surroundings& surroundings = {})
      : printed_(where / "printed") {
    pid_ = fork();
    if (pid_ == 0) become(where, arguments, surroundings);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (pid_ <= 0) return;
    send(SIGKILL);
    wait();
  }

  void send(int signal) const { ::kill(pid_, signal); }
  pid_t process() const { return pid_; }

  /// Its exit code; minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string printed() const { return content(printed_); }

 private:
  [[noreturn]] void become(const fs::path& where, const std::vector<std::string>& arguments,
                           const Surroundings& surroundings) const {
    fs::current_path(where);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
      ::signal(number, SIG_DFL);  // a shell may ignore them
    print_to(surroundings);
    const std::string program = folder_of_programs() / "wheelwright";
    if (!surroundings.fault.empty()) {
      setenv("WHEELWRIGHT_FAULT", surroundings.fault.c_str(), 1);
      setenv("LD_PRELOAD", (folder_of_programs() / "libfault_injection.so").c_str(), 1);
    }
    if (!surroundings.computations.empty()) {
      setenv("WHEELWRIGHT_COMPUTATION_LOG", surroundings.computations.c_str(), 1);
      setenv("LD_PRELOAD", (folder_of_programs() / "libcomputation_log.so").c_str(), 1);
    }
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"})
      setenv(name, surroundings.threads.c_str(), 1);
    const rlimit limit{surroundings.file_size, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(program.c_str(), argv.data());
    _exit(127);
  }

  void print_to(const Surroundings& surroundings) const {
    if (!surroundings.terminal.empty()) setsid();  // makes the terminal that is opened next its own
    const std::string& path = surroundings.terminal.empty() ? printed_ : surroundings.terminal;
    const int out = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
    dup2(out, STDOUT_FILENO);
    dup2(surroundings.messages.empty() ? out : open(surroundings.messages.c_str(), O_WRONLY), STDERR_FILENO);
  }

  std::string printed_;
  pid_t pid_;
};

int last_accepted(const fs::path& run) {
  int last = -1;
  const std::string history = content(run / "history.csv");
  const std::string whole_lines = history.substr(0, history.rfind('\n') + 1);
  for (const std::string& line : split(whole_lines, '\n')) {
    const auto cells = split(line, ',');
    if (cells.size() > 2 && cells[2] == "1") last = std::stoi(cells[0]);
  }
  return last;
}

/// The shape of the newest good checkpoint; -1 without one.
int newest_good(const fs::path& run) {
  for (const fs::path& file : CheckpointFolder(run).files())
    if (const auto checkpoint = parse_checkpoint_file<2>(content(file))) return checkpoint->state.iteration;
  return -1;
}

class Killed : public TemporaryFolder {
 protected:
  static constexpr int every = 3;  // small_case's checkpoint_every
  const std::vector<std::string> begin{"run", "case.toml"}, resume{"resume", "run"};
  const std::string endless = small_case(1000);  // longer than any test waits

  fs::path workplace(const std::string& name, const std::string& case_text) {
    const fs::path place = folder() / name;
    fs::create_directories(place);
    std::ofstream(place / "case.toml") << case_text;
    return place;
  }

  /// A run of the case that nothing disturbed.
  fs::path straight(const std::string& case_text) {
    const fs::path place = workplace("straight", case_text);
    Program program(place, begin);
    EXPECT_EQ(program.wait(), exit_done) << program.printed();
    return place;
  }

  /// Waits until the run has accepted a shape.
  static void wait_for_shape(const fs::path& place, int shape) {
    wait_until([&] { return last_accepted(place / "run") >= shape; });
  }

  template <class Condition>
  static void wait_until(Condition condition) {
    const auto deadline = steady_clock::now() + std::chrono::seconds(60);
    while (!condition() && steady_clock::now() < deadline) std::this_thread::sleep_for(milliseconds(1));
    EXPECT_TRUE(condition());
  }

  void expect_resumes_to(const fs::path& expected, const fs::path& place) {
    Program program(place, resume);
    ASSERT_EQ(program.wait(), exit_done) << program.printed();
    expect_equal_results(expected / "run", place / "run");
  }

  /// Goes on for a few shapes from wherever an endless run was stopped.
  void expect_goes_on_as_if_never_stopped(const fs::path& place) {
    const std::string shapes = std::to_string(last_accepted(place / "run") + 3);
    const fs::path expected =
        workplace(place.filename().string() + "-straight", content(place / "case.toml"));
    Program straight(expected, {"run", "case.toml", "--iterations", shapes});
    ASSERT_EQ(straight.wait(), exit_done) << straight.printed();
    Program resumed(place, {"resume", "run", "--iterations", shapes});
    ASSERT_EQ(resumed.wait(), exit_done) << resumed.printed();
    expect_equal_results(expected / "run", place / "run");
  }

  /// Kills one run again and again, at moments drawn from the time that it takes undisturbed.
  void kill_at_random_moments(int kills, const std::string& case_text) {
    const auto start = steady_clock::now();
    const fs::path expected = straight(case_text);
    const double whole = duration<double>(steady_clock::now() - start).count();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> moment(0, whole);
    fs::path place;
    for (int k = 0; k < kills; ++k) {
      if (place.empty()) place = workplace(fmt::format("killed-{}", k), case_text);
      const bool begun = fs::exists(place / "run/case.toml");
      Program program(place, begun ? resume : begin);
      std::this_thread::sleep_for(duration<double>(moment(random)));
      program.send(SIGKILL);
      const int code = program.wait();
      ASSERT_TRUE(code == -SIGKILL || code == exit_done) << program.printed();
      EXPECT_LE(last_accepted(place / "run") - newest_good(place / "run"), every);
      if (code != exit_done && k + 1 < kills) continue;
      if (!fs::exists(place / "run/case.toml")) continue;
      expect_resumes_to(expected, place);
      fs::remove_all(place);
      place.clear();
    }
  }
};

/// All that an exploration's folder has, but locks, times, and the names of folders.
std::map<std::string, std::string> results_of_designs(const fs::path& all) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(all))
    if (entry.is_regular_file()) files[entry.path().filename()] = content(entry.path());
  for (const auto& entry : fs::directory_iterator(all / "designs")) {
    const std::string name = entry.path().filename();
    if (entry.is_regular_file()) files[name] = content(entry.path());
    if (!entry.is_directory()) continue;
    for (const auto& [file, text] : results(entry.path())) files[name + "/" + file] = text;
  }
  std::erase_if(files, [](const auto& file) {
    return file.first.ends_with(".lock") || file.first.ends_with(list_of_written_files);
  });
  return files;
}

const std::string designs_to_explore = small_case(20) + "errors = \"estimated\"\n";

const std::string solid_to_explore = R"(
[wheel]
dimension = 3
sectors = 8
[material]
poissons_ratio = 0.3
[load]
positions = 1
[contact]
quadrature_points = 3
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 96
axial_cells = 2
degree = 1
tread_levels = 0
[optimizer]
iterations = 3
minimum_wall = 0
minimum_gap = 0
rim_band = 0.0175
tread_band = 0.035
[output]
errors = "estimated"
)";

void expect_equal_files(const std::map<std::string, std::string>& found,
                        const std::map<std::string, std::string>& expected) {
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, text] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == text) << name << ": " << first_difference(text, found.at(name));
  }
}

/// What processes computed, by the log of the library computation_log.
struct Computations {
  int trials = 0;  ///< of all runs
  int lost = 0;    ///< those after the last checkpoint of a killed process, which were computed again
  std::vector<std::string> repeated = {};  ///< others that were computed more than once
};

/// The trials of one run, which processes compute in turn.
class LoggedRun {
 public:
  /// A trial, "SHAPE,TRIAL,ACCEPTED". Returns the process that computed it before; 0 if it is new, -1 if it
  /// was saved.
  int add(int process, const std::string& trial) {
    if (process != process_) times_.clear();
    process_ = process;
    // A run may try a shape again from the start.
    const std::string key = fmt::format("{} {}", trial, times_[trial]++);
    const int shape = std::stoi(trial);
    if (trial.ends_with(",1")) accepted_ = shape;
    if (saved_.contains(key)) return -1;
    return std::exchange(unsaved_[{shape, key}], process);
  }

  /// A checkpoint has all trials up to the last accepted shape.
  void save() {
    std::erase_if(unsaved_, [&](const auto& trial) {
      if (trial.first.first > accepted_) return false;
      saved_.insert(trial.first.second);
      return true;
    });
  }

 private:
  int process_ = 0, accepted_ = 0;
  std::map<std::string, int> times_;
  std::set<std::string> saved_;
  std::map<std::pair<int, std::string>, int> unsaved_;  ///< by their shapes and keys, with their processes
};

Computations computations(const fs::path& log, const std::set<int>& killed) {
  Computations found;
  std::map<std::string, LoggedRun> runs;
  std::ifstream lines(log);
  int process = 0;
  for (std::string run, what; lines >> process >> run >> what;) {
    if (what == "saved") {
      runs[run].save();
      continue;
    }
    ++found.trials;
    const int before = runs[run].add(process, what);
    if (before == 0) continue;
    if (killed.contains(before))
      ++found.lost;
    else
      found.repeated.push_back(run + ": " + what);
  }
  return found;
}

/// One process plans, and `n` run the designs, each of which is killed and replaced twice.
class SharedPlan : public Killed {
 protected:
  fs::path planned(const std::string& name) {
    const fs::path place = workplace(name, designs_to_explore);
    Program plan(place, {"explore", "case.toml", "--starts", "4", "--output", "all", "--plan"});
    EXPECT_EQ(plan.wait(), exit_done) << plan.printed();
    EXPECT_FALSE(fs::exists(place / "all/designs/001/history.csv")) << "a plan computes nothing";
    return place;
  }

  void run_and_kill(const fs::path& place, int n, double whole, std::mt19937& random) {
    std::uniform_real_distribution<double> moment(0, whole / 4);
    std::vector<std::unique_ptr<Program>> programs(n);
    for (auto& program : programs) program = std::make_unique<Program>(place, work);
    for (int k = 0; k < 2 * n; ++k) {
      std::this_thread::sleep_for(duration<double>(moment(random)));
      auto& program = programs[random() % programs.size()];
      program->send(SIGKILL);
      const int code = program->wait();
      EXPECT_TRUE(code == -SIGKILL || code == exit_done) << program->printed();
      program = std::make_unique<Program>(place, work);
    }
    for (auto& program : programs) EXPECT_EQ(program->wait(), exit_done) << program->printed();
  }

  const std::vector<std::string> work{"designs", "all", "--threads", "1"};
};

TEST_F(SharedPlan, IsTheSameForAnyNumberOfProcessesAndDeaths) {
  const fs::path straight = workplace("straight", designs_to_explore);
  const auto start = steady_clock::now();
  Program one(straight, {"explore", "case.toml", "--starts", "4", "--output", "all", "--threads", "1"});
  ASSERT_EQ(one.wait(), exit_done) << one.printed();
  const double whole = duration<double>(steady_clock::now() - start).count();
  const auto expected = results_of_designs(straight / "all");
  ASSERT_TRUE(expected.contains("explore.json") && expected.contains("001.preview.json"));
  ASSERT_TRUE(expected.contains("001.toml") && expected.contains("001/history.csv"));
  std::mt19937 random(1);
  for (int n = 1; n <= 4; ++n) {
    const fs::path place = planned(fmt::format("shared-{}", n));
    run_and_kill(place, n, whole, random);
    expect_equal_files(results_of_designs(place / "all"), expected);
  }
}

// Two processes in turn are killed when they have computed for a while. The starts are those of the plane.
TEST_F(SharedPlan, InThreeDimensionsIsTheSameAfterDeaths) {
  const std::vector<std::string> explore{"explore",  "case.toml", "--starts",  "3",
                                         "--output", "all",       "--threads", "1"};
  const fs::path straight = workplace("straight", solid_to_explore);
  const auto start = steady_clock::now();
  Program one(straight, explore);
  ASSERT_EQ(one.wait(), exit_done) << one.printed();
  const double whole = duration<double>(steady_clock::now() - start).count();
  EXPECT_NE(one.printed().find("s of one core for a shape"), std::string::npos) << one.printed();
  const auto expected = results_of_designs(straight / "all");
  EXPECT_NE(expected.at("explore.html").find("\"outline\":\"M"), std::string::npos);
  EXPECT_NE(expected.at("001.full.json").find("strain_energy_J\""), std::string::npos);
  EXPECT_TRUE(expected.contains("002.toml") && expected.contains("001.finer.json"));
  const fs::path place = workplace("killed", solid_to_explore);
  for (const double share : {0.4, 0.3}) {
    Program program(place, explore);
    std::this_thread::sleep_for(duration<double>(share * whole));
    program.send(SIGKILL);
    ASSERT_EQ(program.wait(), -SIGKILL) << program.printed();
  }
  Program last(place, explore);
  ASSERT_EQ(last.wait(), exit_done) << last.printed();
  expect_equal_files(results_of_designs(place / "all"), expected);
}

// Four processes work on 24 designs. One of them is killed at 20 random moments and replaced at once; a fifth
// joins when half of the deaths have happened.
TEST_F(SharedPlan, SlowOfManyDeathsComputesNothingTwiceThatWasSaved) {
  const auto plan = [&](const std::string& name) {
    const fs::path place = workplace(name, designs_to_explore);
    EXPECT_EQ(Program(place, {"explore", "case.toml", "--starts", "24", "--output", "all", "--plan"}).wait(),
              exit_done);
    for (const auto& entry : fs::directory_iterator(place / "all/designs")) {  // saved every third shape
      if (entry.path().extension() != ".toml") continue;
      std::string text = content(entry.path());
      const std::string usual = "checkpoint_every = 50";
      text.replace(text.find(usual), usual.size(), "checkpoint_every = 3");
      std::ofstream(entry.path()) << text;
    }
    return place;
  };
  const Surroundings logged{.computations = "log"};
  const fs::path straight = plan("straight"), place = plan("shared");
  const auto start = steady_clock::now();
  ASSERT_EQ(Program(straight, work, logged).wait(), exit_done);
  const double whole = duration<double>(steady_clock::now() - start).count();
  const Computations once = computations(straight / "log", {});
  EXPECT_EQ(once.repeated, std::vector<std::string>());

  std::mt19937 random(1);
  std::uniform_real_distribution<double> pause(0, whole / 60);
  std::set<int> killed;
  std::vector<std::unique_ptr<Program>> programs(4);
  for (auto& program : programs) program = std::make_unique<Program>(place, work, logged);
  for (int death = 0; death < 20; ++death) {
    std::this_thread::sleep_for(duration<double>(pause(random)));
    auto& program = programs[random() % 4];
    killed.insert(program->process());
    program->send(SIGKILL);
    EXPECT_EQ(program->wait(), -SIGKILL) << "ended before death " << death;
    program = std::make_unique<Program>(place, work, logged);
    if (death == 10) programs.push_back(std::make_unique<Program>(place, work, logged));
  }
  for (auto& program : programs) EXPECT_EQ(program->wait(), exit_done) << program->printed();
  expect_equal_files(results_of_designs(place / "all"), results_of_designs(straight / "all"));
  const Computations shared = computations(place / "log", killed);
  EXPECT_EQ(shared.repeated, std::vector<std::string>());
  EXPECT_EQ(shared.trials, once.trials + shared.lost);
  EXPECT_GT(shared.lost, 0);
  std::printf("%d trials, %d of them lost by %zu deaths\n", shared.trials, shared.lost, killed.size());
}

// As jobs of a batch system do: one per design, in any order, again until nothing is due, and one that
// collects.
TEST_F(SharedPlan, ConsistsOfStepsForABatchSystem) {
  const fs::path straight = workplace("straight", designs_to_explore), place = planned("jobs");
  Program one(straight, {"explore", "case.toml", "--starts", "4", "--output", "all", "--threads", "1"});
  ASSERT_EQ(one.wait(), exit_done) << one.printed();
  Program early(place, {"designs", "all", "--collect"});
  EXPECT_EQ(early.wait(), exit_no_solution) << early.printed();
  EXPECT_NE(early.printed().find("001, 002, 003, 004"), std::string::npos) << early.printed();
  for (int round = 0; round < 4; ++round)
    for (const char* number : {"4", "2", "1", "3"}) {
      Program job(place, {"designs", "all", "--only", number, "--threads", "1"});
      ASSERT_EQ(job.wait(), exit_done) << job.printed();
    }
  ASSERT_EQ(Program(place, {"designs", "all", "--collect"}).wait(), exit_done);
  EXPECT_EQ(results_of_designs(place / "all"), results_of_designs(straight / "all"));
}

// The code by which a job knows that it must continue later.
TEST_F(SharedPlan, StoppedBeforeAnyDesignHasEndedExitsLikeAnyStoppedRun) {
  const fs::path place = planned("stopped");
  Program job(place, work);
  wait_until([&] { return last_accepted(place / "all/designs/001") >= 1; });
  job.send(SIGSTOP);
  ASSERT_FALSE(fs::exists(place / "all/designs/001.preview.json"));
  job.send(SIGTERM);
  job.send(SIGCONT);
  EXPECT_EQ(job.wait(), exit_terminated) << job.printed();
  EXPECT_GE(newest_good(place / "all/designs/001"), 1);
}

TEST_F(SharedPlan, StopsAndContinuesLater) {
  const fs::path place = planned("stopped");
  Program job(place, {"designs", "all", "--only", "2", "--threads", "1"});
  wait_until([&] { return last_accepted(place / "all/designs/002") >= 2; });
  job.send(SIGSTOP);
  EXPECT_EQ(Program(place, {"designs", "all", "--only", "2"}).wait(), exit_refused);
  job.send(SIGTERM);
  job.send(SIGCONT);
  EXPECT_EQ(job.wait(), exit_terminated) << job.printed();
  EXPECT_FALSE(fs::exists(place / "all/designs/002.preview.json"));
  EXPECT_GE(newest_good(place / "all/designs/002"), 2);
  EXPECT_EQ(Program(place, {"designs", "all", "--only", "2"}).wait(), exit_done);
  EXPECT_TRUE(fs::exists(place / "all/designs/002.preview.json"));
}

TEST_F(Killed, AtRandomMomentsLosesAtMostOneInterval) { kill_at_random_moments(6, small_case(12)); }

TEST_F(Killed, SlowAHundredTimesLosesAtMostOneInterval) { kill_at_random_moments(100, small_case(40)); }

TEST_F(Killed, WhileWritingACheckpointContinues) {
  const std::string text = small_case(7);
  const fs::path expected = straight(text);
  // A save writes once, synchronizes file and folder, and renames once. Shapes 0, 3, 6 and 7 are saved, and 7
  // again as finished.
  for (const char* fault : {"write:1:kill", "write:2:kill", "write:5:kill", "fsync:3:kill", "fsync:4:kill",
                            "rename:2:kill", "rename:5:kill"}) {
    SCOPED_TRACE(fault);
    const fs::path place = workplace(fault, text);
    ASSERT_EQ(Program(place, begin, {.fault = fault}).wait(), -SIGKILL);
    EXPECT_LE(last_accepted(place / "run") - newest_good(place / "run"), every);
    expect_resumes_to(expected, place);
  }
}

TEST_F(Killed, FailedWriteExitsWithCode5AndKeepsTheOldCheckpoint) {
  const std::string text = small_case(7);
  const fs::path expected = straight(text);
  for (const auto& [call, error] : {std::pair{"write", ENOSPC}, {"fsync", EIO}, {"rename", EROFS}}) {
    SCOPED_TRACE(call);
    const fs::path place = workplace(call, text);
    Program program(place, begin, {.fault = fmt::format("{}:3:{}", call, error)});
    ASSERT_EQ(program.wait(), exit_input_output);
    const int lost = std::string_view(call) == "fsync" ? 3 : 6;
    EXPECT_NE(program.printed().find(fmt::format("run/checkpoints/shape_{:06}.checkpoint", lost)),
              std::string::npos)
        << program.printed();
    EXPECT_EQ(newest_good(place / "run"), lost - every);
    expect_resumes_to(expected, place);
  }
}

TEST_F(Killed, BeyondTheFileSizeLimitExitsWithCode5AndContinuesLater) {
  const std::string text = small_case_of_any_width(7);
  const fs::path expected = straight(text), place = workplace("limited", text);
  ASSERT_EQ(Program(place, {"run", "case.toml", "--iterations", "3"}).wait(), exit_done);
  const std::vector<std::string> further{"resume", "run", "--iterations", "7"};
  Program program(place, further, {.file_size = 4096});
  EXPECT_EQ(program.wait(), exit_input_output);
  EXPECT_NE(program.printed().find("cannot write run/"), std::string::npos) << program.printed();
  EXPECT_EQ(newest_good(place / "run"), 3);
  ASSERT_EQ(Program(place, further).wait(), exit_done);
  expect_equal_results(expected / "run", place / "run");
}

/// Runs a script in a mount namespace of its own; nothing when this machine allows none.
std::optional<int> in_own_mounts(const fs::path& where, const std::string& script) {
  const auto shell = [&](const std::string& text) {
    const std::string command = fmt::format(
        "cd '{}' && unshare --user --map-root-user --mount sh -c '{}' >> printed 2>&1", where.string(), text);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  if (shell("mount -t tmpfs none /mnt") != 0) return {};
  return shell(script);
}

TEST_F(Killed, OnAFullDiskExitsWithCode5AndContinuesLater) {
  const std::string text = small_case(7);
  const fs::path expected = straight(text), place = workplace("full", text);
  const std::string program = folder_of_programs() / "wheelwright";
  fs::create_directories(place / "run");
  const auto code = in_own_mounts(place, fmt::format(R"(
mount -t tmpfs -o size=400k none run || exit 99
"{0}" run case.toml; echo "code $?"
mount -o remount,size=20m run
"{0}" resume run || exit 98
cp -r run saved)",
                                                     program));
  if (!code) GTEST_SKIP() << "no mount namespaces for this user";
  ASSERT_EQ(*code, 0) << content(place / "printed");
  const std::string printed = content(place / "printed");
  EXPECT_NE(printed.find("code 5"), std::string::npos) << printed;
  EXPECT_NE(printed.find("cannot write run/"), std::string::npos) << printed;
  expect_equal_results(expected / "run", place / "saved");
}

TEST_F(Killed, InAReadOnlyFolderExitsWithCode5WithoutChanges) {
  const fs::path place = straight(small_case(3));
  const auto before = results(place / "run");
  const auto code =
      in_own_mounts(place, fmt::format(R"(mount --bind run run && mount -o remount,ro,bind run || exit 99
"{}" resume run --iterations 5)",
                                       (folder_of_programs() / "wheelwright").string()));
  if (!code) GTEST_SKIP() << "no mount namespaces for this user";
  EXPECT_EQ(*code, exit_input_output) << content(place / "printed");
  EXPECT_NE(content(place / "printed").find("cannot write run/"), std::string::npos);
  EXPECT_EQ(results(place / "run"), before);
}

TEST_F(Killed, SignalsSaveAndStop) {
  for (const auto& [signal, code] :
       {std::pair{SIGINT, exit_interrupted}, {SIGTERM, exit_terminated}, {SIGHUP, exit_hung_up}}) {
    const fs::path place = workplace(std::to_string(signal), endless);
    Program program(place, begin);
    wait_for_shape(place, 4);
    program.send(signal);
    ASSERT_EQ(program.wait(), code) << program.printed();
    EXPECT_EQ(newest_good(place / "run"), last_accepted(place / "run"));
    expect_goes_on_as_if_never_stopped(place);
  }
}

// Nothing is saved yet, and the program does not say so; the run begins again.
TEST_F(Killed, StopDuringTheFirstShapeAllowsARestart) {
  const std::string slow =
      "[wheel]\nsectors = 4\n[load]\npositions = 8\n[grid]\nradial_cells = 56\nangular_cells = 1536\n"
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.04\n[optimizer]\niterations = 0\n"
      "[output]\nfolder = \"run\"\n";
  // Too early a stop lets the first shape finish, and so does one that is too late.
  for (const int delay : {200, 400, 800, 1600, 3200}) {
    const fs::path place = workplace(std::to_string(delay), slow);
    Program program(place, begin);
    wait_until([&] { return fs::exists(place / "run/history.csv"); });
    std::this_thread::sleep_for(milliseconds(delay));
    program.send(SIGINT);
    const int code = program.wait();
    if (last_accepted(place / "run") >= 0) continue;
    EXPECT_EQ(code, exit_nothing_saved);
    EXPECT_EQ(newest_good(place / "run"), -1);
    EXPECT_EQ(program.printed().find(", saved"), std::string::npos) << program.printed();
    expect_resumes_to(straight(slow), place);
    return;
  }
  FAIL() << "no stop came while the first shape was evaluated";
}

// Its pictures are those of the last shape; the checkpoint stays one to go on from.
TEST_F(Killed, AStoppedRunWritesItsPictures) {
  for (const bool by_file : {false, true}) {
    const fs::path place = workplace(by_file ? "file" : "signal", endless), run = place / "run";
    Program program(place, begin);
    wait_for_shape(place, 4);
    if (by_file)
      std::ofstream(run / "STOP");
    else
      program.send(SIGTERM);
    ASSERT_EQ(program.wait(), exit_terminated) << program.printed();
    for (const char* file : {"shape.svg", "comparison.svg", "stress.svg", "mesh.svg", "pressures_final.svg"})
      EXPECT_TRUE(fs::exists(run / file)) << file;
    EXPECT_NE(content(run / "comparison.svg").find(fmt::format("after {} shapes", last_accepted(run))),
              std::string::npos);
    expect_goes_on_as_if_never_stopped(place);
  }
}

// Whether something is saved, the exit code says, whenever the signal comes: 8 where nothing is.
TEST_F(Killed, EarlySignalIsReportedCorrectly) {
  for (int delay = 0; delay < 60; delay += 3) {
    const fs::path place = workplace(std::to_string(delay), endless);
    Program program(place, begin);
    std::this_thread::sleep_for(milliseconds(delay));
    program.send(SIGTERM);
    const int code = program.wait();
    SCOPED_TRACE(fmt::format("{} ms, code {}: {}", delay, code, program.printed()));
    if (code == -SIGTERM) {  // before main()
      EXPECT_FALSE(fs::exists(place / "run"));
      continue;
    }
    EXPECT_TRUE(code == exit_terminated || code == exit_nothing_saved);
    EXPECT_EQ(newest_good(place / "run") >= 0, code == exit_terminated);
    if (fs::exists(place / "run")) expect_goes_on_as_if_never_stopped(place);
  }
}

// The pictures of a large wheel take longer than a machine may wait that is switched off.
TEST_F(Killed, SecondSignalSkipsThePictures) {
  const fs::path place = workplace("large", R"(
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 28
angular_cells = 384
tread_levels = 4
[load]
positions = 64
[output]
folder = "run"
vtu_every = 0
)");
  Program program(place, begin);
  wait_for_shape(place, 0);
  program.send(SIGTERM);
  wait_until([&] { return program.printed().find("stopping after") != std::string::npos; });
  const auto start = steady_clock::now();
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), exit_terminated);
  EXPECT_LT(duration<double>(steady_clock::now() - start).count(), 0.3);
  EXPECT_FALSE(fs::exists(place / "run/stress.svg"));
  EXPECT_GE(newest_good(place / "run"), 0);
}

TEST_F(Killed, SecondSignalExitsAtOnce) {
  const fs::path place = workplace("twice", endless);
  Program program(place, begin);
  wait_for_shape(place, 4);
  // Both are pending when it continues, so that the second comes before the loop has asked for the first.
  for (const int signal : {SIGSTOP, SIGINT, SIGTERM, SIGCONT}) program.send(signal);
  const int code = program.wait();
  EXPECT_TRUE(code == exit_interrupted || code == exit_terminated) << code;
  EXPECT_EQ(program.printed().find("saved"), std::string::npos);
  EXPECT_LE(last_accepted(place / "run") - newest_good(place / "run"), every);
  expect_goes_on_as_if_never_stopped(place);
}

// The kernel sends SIGHUP, and nothing can be printed any more. A shell sends it once more.
TEST_F(Killed, AClosedTerminalSavesAndStops) {
  const fs::path place = workplace("terminal", endless);
  Terminal terminal;
  Program program(place, begin, {.terminal = terminal.path()});
  wait_for_shape(place, 4);
  terminal.close();
  program.send(SIGHUP);
  ASSERT_EQ(program.wait(), exit_hung_up);
  EXPECT_EQ(newest_good(place / "run"), last_accepted(place / "run"));
  expect_goes_on_as_if_never_stopped(place);
}

TEST_F(Killed, HangUpDoesNotCountAsTheFirstSignal) {
  const fs::path place = workplace("hung-up", endless);
  Program program(place, begin);
  wait_for_shape(place, 4);
  for (const int signal : {SIGSTOP, SIGHUP, SIGTERM, SIGCONT}) program.send(signal);
  EXPECT_EQ(program.wait(), exit_terminated);
  EXPECT_EQ(newest_good(place / "run"), last_accepted(place / "run"));
  expect_goes_on_as_if_never_stopped(place);
}

TEST_F(Killed, WithoutMemoryExitsWithCode4AndContinuesLater) {
  const std::string text = small_case(7);
  const fs::path expected = straight(text);
  int reached = -1;
  for (const int request : {300, 1000, 2500, 4000, 6000}) {
    const fs::path place = workplace(fmt::format("without-memory-{}", request), text);
    Program program(place, {"run", "case.toml", "--threads", "1"},
                    {.fault = fmt::format("new:{}:throw", request)});
    ASSERT_EQ(program.wait(), exit_refused) << program.printed();
    EXPECT_NE(program.printed().find("memory"), std::string::npos);
    reached = last_accepted(place / "run");
    EXPECT_LE(reached - newest_good(place / "run"), every);
    expect_resumes_to(expected, place);
  }
  EXPECT_GE(reached, 3) << "the last fault comes in the middle of a run";
}

TEST_F(Killed, UnwritableMessagesAreIgnored) {
  const std::string text = small_case(4);
  const fs::path expected = straight(text), place = workplace("silent", text);
  const Surroundings mute{.messages = "/dev/full"};
  ASSERT_EQ(Program(place, {"run", "case.toml", "--iterations", "2"}, mute).wait(), exit_done);
  ASSERT_EQ(Program(place, {"resume", "run", "--iterations", "4"}, mute).wait(), exit_done);
  expect_equal_results(expected / "run", place / "run");
}

TEST_F(Killed, Usr1SavesAndContinues) {
  std::string text = endless;
  text.replace(text.find("checkpoint_every = 3"), 20, "checkpoint_every = 0");
  const fs::path place = workplace("asked", text);
  Program program(place, begin);
  wait_for_shape(place, 3);
  program.send(SIGUSR1);
  wait_until([&] { return newest_good(place / "run") > 0; });
  wait_for_shape(place, newest_good(place / "run") + 1);
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL) << program.printed();
  EXPECT_GE(newest_good(place / "run"), 3);
  expect_goes_on_as_if_never_stopped(place);
}

TEST_F(Killed, WithAnyNumberOfThreadsItIsTheSame) {
  // Matrices that are large enough for BLAS to use threads.
  const std::string text = small_case(2, R"(
[objective]
strain_energy = 1
uniformity_dual = 100
)");
  const fs::path expected = straight(text), place = workplace("threads", text);
  ASSERT_EQ(
      Program(place, {"run", "case.toml", "--iterations", "1", "--threads", "1"}, {.threads = "2"}).wait(),
      exit_done);
  ASSERT_EQ(Program(place, {"resume", "run", "--iterations", "2", "--threads", "3"}, {.threads = "4"}).wait(),
            exit_done);
  expect_equal_results(expected / "run", place / "run");
}

TEST_F(Killed, TwoRunsCannotShareAFolder) {
  const fs::path place = workplace("shared", endless);
  Program first(place, begin);
  wait_for_shape(place, 1);
  first.send(SIGSTOP);
  EXPECT_EQ(Program(place, begin).wait(), exit_refused);
  EXPECT_EQ(Program(place, resume).wait(), exit_refused);
  first.send(SIGKILL);
  EXPECT_EQ(first.wait(), -SIGKILL);
  expect_goes_on_as_if_never_stopped(place);
}

}  // namespace
}  // namespace wheelwright::testing
