#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/guarded.h"
#include "wheelwright/case/read.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/checkpoints/folder_lock.h"
#include "wheelwright/run/study/problem_size.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright::testing {
namespace {

const std::filesystem::path source(WHEELWRIGHT_SOURCE_DIR);

struct Outcome {
  int code;
  std::string output;  ///< standard output and error
};

/// Runs the program that the build put beside this test, in a folder.
Outcome wheelwright(const std::string& arguments, const std::filesystem::path& folder = ".") {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  const std::string command =
      fmt::format("cd '{}' && '{}' {} 2>&1", folder.string(), program.string(), arguments);
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

std::string path_of_case(const std::string& name) { return fmt::format("'{}'", (source / name).string()); }

class CommandLine : public TemporaryFolder {
 protected:
  std::string in_folder(const std::string& name) const {
    return fmt::format("'{}'", (folder() / name).string());
  }
};

TEST_F(CommandLine, InitWritesThePresetsThatItLists) {
  const Outcome list = wheelwright("init --list", folder());
  EXPECT_EQ(list.code, exit_done);
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
  std::istringstream lines(list.output);
  int n = 0;
  for (std::string line; std::getline(lines, line); ++n) {
    const std::string name = line.substr(0, line.find(' '));
    EXPECT_EQ(wheelwright(fmt::format("init {0}.toml --preset {0}", name), folder()).code, exit_done) << name;
    EXPECT_EQ(wheelwright(fmt::format("check {}.toml", name), folder()).code, exit_done) << name;
  }
  EXPECT_GE(n, 8);
  EXPECT_EQ(wheelwright("init other.toml --preset other", folder()).code, exit_usage);
  EXPECT_FALSE(std::filesystem::exists(folder() / "other.toml"));
}

TEST_F(CommandLine, HelpAndVersionSucceed) {
  EXPECT_EQ(wheelwright("--help").code, exit_done);
  EXPECT_EQ(wheelwright("run --help").code, exit_done);
  EXPECT_EQ(wheelwright("--version").code, exit_done);
}

// CASE stands for a good case, so that nothing but the words after it can be wrong.
constexpr const char* wrong_command_lines[] = {"",
                                               "fly",
                                               "''",
                                               "-x",
                                               "--fast",
                                               "check check",
                                               "run --version",
                                               "check",
                                               "check --fast CASE",
                                               "check CASE CASE",
                                               "check CASE --iterations 1",
                                               "check CASE --output x",
                                               "verify",
                                               "verify --fast CASE",
                                               "verify CASE CASE",
                                               "verify CASE --json",
                                               "reference x",
                                               "reference --fast",
                                               "init x y",
                                               "init --fast x",
                                               "init --output x",
                                               "run",
                                               "run --fast CASE",
                                               "run CASE CASE",
                                               "run CASE --json",
                                               "run CASE --loads 1",
                                               "run CASE check",
                                               "run CASE --output ''",
                                               "run CASE --output",
                                               "run CASE --output x --output y",
                                               "run CASE --iterations",
                                               "run CASE --iterations ''",
                                               "run CASE --iterations ' '",
                                               "run CASE --iterations -1",
                                               "run CASE --iterations two",
                                               "run CASE --iterations 1.5",
                                               "run CASE --iterations 1e3",
                                               "run CASE --iterations nan",
                                               "run CASE --iterations inf",
                                               "run CASE --iterations 1000001",
                                               "run CASE --iterations 2147483648",
                                               "run CASE --iterations 99999999999999999999",
                                               "run CASE --iterations 1 --iterations 2",
                                               "run CASE --iterations '1 2'",
                                               "run CASE --iterations=1,2",
                                               "resume",
                                               "resume .",
                                               "resume ''",
                                               "resume none",
                                               "resume . --iterations -1",
                                               "resume . --fast",
                                               "resume . --output x",
                                               "analyze",
                                               "analyze --fast CASE",
                                               "analyze CASE CASE",
                                               "analyze CASE --iterations 1",
                                               "analyze CASE --json=maybe",
                                               "analyze CASE --output ''",
                                               "analyze CASE --positions",
                                               "analyze CASE --positions ''",
                                               "analyze CASE --positions 0",
                                               "analyze CASE --positions -1",
                                               "analyze CASE --positions 1001",
                                               "analyze CASE --positions nan",
                                               "analyze CASE --positions 1e2",
                                               "analyze CASE --positions 4294967297",
                                               "analyze CASE --loads",
                                               "analyze CASE --loads ''",
                                               "analyze CASE --loads ' '",
                                               "analyze CASE --loads 0",
                                               "analyze CASE --loads 0,1",
                                               "analyze CASE --loads -1",
                                               "analyze CASE --loads nan",
                                               "analyze CASE --loads inf",
                                               "analyze CASE --loads 1e999",
                                               "analyze CASE --loads 1e-999",
                                               "analyze CASE --loads 1,nan",
                                               "analyze CASE --loads 1,",
                                               "analyze CASE --loads ,1",
                                               "analyze CASE --loads 1,,2",
                                               "analyze CASE --loads '1, 2'",
                                               "analyze CASE --loads 1:2",
                                               "analyze CASE --loads 1:2:1",
                                               "analyze CASE --loads 1:2:1.5",
                                               "analyze CASE --loads 1:2:nan",
                                               "analyze CASE --loads 1:2:1e99",
                                               "analyze CASE --loads 1:2:1001",
                                               "analyze CASE --loads 1:inf:3",
                                               "analyze CASE --loads 0:2:3",
                                               "analyze CASE --loads 1:2:3:4",
                                               "analyze CASE --loads 1:2,3",
                                               "analyze CASE --loads 0x10",
                                               "analyze CASE --loads 1N",
                                               "analyze CASE --loads 1 --loads 2"};

TEST_F(CommandLine, WrongUsageExitsWithCode2AndWritesNothing) {
  for (const std::string line : wrong_command_lines) {
    const std::string arguments =
        std::regex_replace(line, std::regex("CASE"), path_of_case("cases/holes16.toml"));
    const Outcome outcome = wheelwright(arguments, folder());
    EXPECT_EQ(outcome.code, exit_usage) << line << '\n' << outcome.output;
    EXPECT_FALSE(outcome.output.empty()) << line;
    EXPECT_TRUE(std::filesystem::is_empty(folder())) << line;
  }
}

TEST_F(CommandLine, CheckAcceptsAGoodCaseAndRefusesABadOne) {
  for (const char* name : {"holes16", "tram", "bicycle", "scooter"})
    EXPECT_EQ(wheelwright("check " + path_of_case(fmt::format("cases/{}.toml", name))).code, exit_done)
        << name;
  const std::string bad = path_of_case("tests/bad_cases/everything.toml");
  for (const char* command : {"check ", "run ", "verify ", "analyze "}) {
    const Outcome outcome = wheelwright(command + bad);
    EXPECT_EQ(outcome.code, exit_usage);
    EXPECT_NE(outcome.output.find("everything.toml:2:1: titel"), std::string::npos) << outcome.output;
  }
}

TEST_F(CommandLine, BadCasesWriteNothing) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source / "tests" / "bad_cases")) {
    const Outcome outcome = wheelwright(fmt::format("run '{}'", entry.path().string()), folder());
    EXPECT_EQ(outcome.code, exit_usage) << entry.path() << outcome.output;
    EXPECT_TRUE(std::filesystem::is_empty(folder())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 100);
}

TEST_F(CommandLine, UnreadableCaseExitsWithCode2) {
  for (const char* command : {"check ", "run ", "verify ", "analyze "})
    for (const std::string& file :
         {in_folder("none.toml"), in_folder(""), std::string("''"), std::string("/dev/null")})
      EXPECT_EQ(wheelwright(command + file, folder()).code, exit_usage) << command << file;
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

/// Whether a terminal would show only text.
bool is_plain(std::string_view output) {
  return std::ranges::all_of(output, [](unsigned char c) { return c == '\n' || (c >= 0x20 && c != 0x7f); }) &&
         output.find("\xc2\x9b") == std::string_view::npos;
}

TEST_F(CommandLine, NothingInACaseOrItsNameControlsTheTerminal) {
  const std::string evil =
      "a\x1b]0;b\x07\x7f\xc2\x9b"
      "31m";
  const std::string quoted = "a\\u001b]0;b\\u0007\\u007f\\u009b31m";
  const std::string wheel = small_wheel + "[optimizer]\niterations = 0\n";
  std::ofstream(folder() / "title.toml") << "title = \"" << quoted << "\"\n" << wheel;
  std::ofstream(folder() / "folder.toml") << wheel << "[output]\nfolder = \"" << quoted << "\"\n";
  std::ofstream(folder() / "key.toml") << wheel << '"' << quoted << "\" = 1\n";
  std::ofstream(folder() / (evil + ".toml")) << wheel;
  std::ofstream(folder() / (evil + "bad.toml")) << "[wheel]\nsectors = 0\n";
  const std::string name = fmt::format("'{}", evil);
  for (const std::string& arguments :
       {std::string("check title.toml"), std::string("run title.toml --output title"),
        std::string("analyze title.toml --positions 1"),
        std::string("analyze title.toml --positions 1 --json"), std::string("check folder.toml"),
        std::string("run folder.toml"), std::string("check key.toml"), "check " + name + ".toml'",
        "run " + name + ".toml'", "check " + name + "bad.toml'", "check " + name + "none.toml'",
        "run title.toml --output " + name + "'", "resume " + name + "'", "resume " + name + "none'",
        "init " + name + ".toml'", "fly " + name + "'"}) {
    const Outcome outcome = wheelwright(arguments, folder());
    EXPECT_FALSE(outcome.output.empty()) << arguments;
    EXPECT_TRUE(is_plain(outcome.output)) << arguments << '\n' << outcome.output;
  }
}

TEST_F(CommandLine, ThousandsOfProblemsAreCountedAndNotAllShown) {
  {
    std::ofstream file(folder() / "bytes.toml");
    for (int line = 0; line < 500'000; ++line) file << "\xff\n";
  }
  const Outcome outcome = wheelwright("check bytes.toml", folder());
  EXPECT_EQ(outcome.code, exit_usage);
  EXPECT_NE(outcome.output.find("500000 problems"), std::string::npos);
  EXPECT_LT(outcome.output.size(), 100'000u);
}

// With less address space than its buffers need, BLAS would try for ever to get it.
TEST_F(CommandLine, MissingAddressSpaceExitsWithCode4) {
  std::ofstream(folder() / "c.toml") << small_case(0);
  const auto within = [&](int kilobytes) {
    const std::string command =
        fmt::format("cd '{}' && ulimit -v {} && exec timeout -s KILL 20 '{}' run c.toml > printed 2>&1",
                    folder().string(), kilobytes,
                    (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "wheelwright").string());
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  for (const int megabytes : {100, 150, 200, 250, 300}) {
    EXPECT_EQ(within(megabytes * 1024), exit_refused) << megabytes;
    EXPECT_NE(content(folder() / "printed").find("ulimit -v"), std::string::npos) << megabytes;
    EXPECT_FALSE(std::filesystem::exists(folder() / "run"));
  }
  EXPECT_EQ(within(64 * 1024 * 1024), exit_done) << content(folder() / "printed");
}

TEST_F(CommandLine, UnwritableFileExitsWithCode5) {
  EXPECT_EQ(wheelwright("init " + in_folder("no/folder.toml")).code, exit_input_output);
  EXPECT_EQ(wheelwright("reference > /dev/full").code, exit_input_output);
  EXPECT_EQ(wheelwright("check " + path_of_case("cases/holes16.toml") + " > /dev/full").code,
            exit_input_output);
  // More than fits a buffer.
  EXPECT_EQ(wheelwright("analyze " + path_of_case("cases/holes16.toml") +
                        " --positions 1 --loads 1000:3000:100 --json > /dev/full")
                .code,
            exit_input_output);
}

/// Two rings of holes that together cut the tread off: no rule about cases finds that, the solver does.
constexpr const char* unsolvable_case = R"(
[wheel]
sectors = 8
[load]
positions = 1
[[holes.ring]]
count = 24
center_radius = 0.27
radius = 0.028
[[holes.ring]]
count = 24
center_radius = 0.27
radius = 0.028
phase = 0
[grid]
radial_cells = 8
angular_cells = 96
[optimizer]
rim_band = 0.0175
tread_band = 0.035
)";

TEST_F(CommandLine, UnsolvableShapeExitsWithCode3) {
  std::ofstream(folder() / "cut.toml") << unsolvable_case;
  for (const char* command : {"run cut.toml --output cut", "resume cut", "analyze cut.toml"})
    EXPECT_EQ(wheelwright(command, folder()).code, exit_no_solution) << command;
}

// The volume at which a run ends may not be its target's yet, or a target that no wheel survives: the end
// names the key.
TEST_F(CommandLine, UnreachedVolumeIsReported) {
  const auto run = [&](const std::string& name, const std::string& volume, int iterations = 2) {
    std::ofstream(folder() / (name + ".toml"))
        << "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.028\n"
           "[grid]\nradial_cells = 7\nangular_cells = 128\n[optimizer]\nrim_band = 0.02\ntread_band = "
           "0.04\n[volume]\n"
        << volume;
    return wheelwright(fmt::format("run {0}.toml --output {0} --iterations {1}", name, iterations), folder());
  };
  const Outcome early = run("early", "target = 0.7\n");
  EXPECT_EQ(early.code, exit_done) << early.output;
  EXPECT_NE(early.output.find("volume.target = 0.7"), std::string::npos) << early.output;
  const Outcome there = run("there", "target = 0.8\nrate = 0.1\n");
  EXPECT_EQ(there.code, exit_done) << there.output;
  EXPECT_EQ(there.output.find("volume.target"), std::string::npos) << there.output;
  for (const char* volume : {"target = 0.46\ncontrol = \"paper\"\n", "target = 0.455\nrate = 0.03\n"}) {
    const Outcome gave_up = run(fmt::format("gave-up-{}", std::strlen(volume)), volume, 60);
    EXPECT_EQ(gave_up.code, exit_no_solution) << gave_up.output;
    EXPECT_NE(gave_up.output.find("volume.target = 0.4"), std::string::npos) << gave_up.output;
  }
  const Outcome apart = run("apart", "target = 0.47\nrate = 1\n");
  EXPECT_EQ(apart.code, exit_no_solution) << apart.output;
  EXPECT_NE(apart.output.find("volume.target = 0.47"), std::string::npos) << apart.output;
}

// A Taylor test finds order 2 for a hole; without one nothing can move.
TEST_F(CommandLine, VerifyTestsTheGradientOfTheCasesShape) {
  std::ofstream(folder() / "full.toml")
      << "[grid]\nradial_cells = 7\nangular_cells = 128\n[optimizer]\nrim_band = 0.02\ntread_band = 0.04\n";
  EXPECT_EQ(wheelwright("verify full.toml", folder()).code, exit_no_solution);
  const Outcome outcome = wheelwright("verify " + path_of_case("cases/holes16.toml"));
  EXPECT_EQ(outcome.code, exit_done) << outcome.output;
  int functions = 0;
  const std::regex order("(objective|volume) .* ([0-9.]+|rounding)  passed");
  for (std::sregex_iterator found(outcome.output.begin(), outcome.output.end(), order), end; found != end;
       ++found, ++functions)
    if ((*found)[2] != "rounding") {
      EXPECT_NEAR(std::stod((*found)[2]), 2, 0.1);
    }
  EXPECT_EQ(functions, 2) << outcome.output;
}

// Radii that are unknowns are tested too, also where no hole could move.
TEST_F(CommandLine, VerifyTestsTheDerivativesByRadii) {
  std::ofstream(folder() / "layers.toml") << R"([[material.layer]]
name = "core"
outer_radius = 0.26
outer_radius_range = [0.25, 0.28]
youngs_modulus = 9e8
poissons_ratio = 0.3
[grid]
radial_cells = 15
angular_cells = 128
[optimizer]
rim_band = 0.02
tread_band = 0.04
)";
  const Outcome outcome = wheelwright("verify layers.toml", folder());
  EXPECT_EQ(outcome.code, exit_done) << outcome.output;
  EXPECT_TRUE(std::regex_search(outcome.output,
                                std::regex("objective, outer_radius of core .* (1\\.9|2\\.0)[0-9]*  passed")))
      << outcome.output;
}

// Exploring a case that minimizes its mass once generated starts forever, and neither time nor a signal ended
// it.
TEST_F(CommandLine, ExploreStopsWhileGeneratingStarts) {
  std::ofstream(folder() / "mass.toml") << R"([[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[material]
density = 1100
[objective]
minimize = "mass"
[[constraint]]
quantity = "stiffness"
at_least = 40e6
)";
  const Outcome in_time = wheelwright("explore mass.toml --starts 999 --seconds 1 --output timed", folder());
  EXPECT_EQ(in_time.code, exit_no_solution) << in_time.output;
  EXPECT_NE(in_time.output.find("of 999"), std::string::npos) << in_time.output;
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  // In the foreground `timeout` signals once; otherwise its process group too, and a second signal kills.
  const int status = std::system(
      fmt::format("cd '{}' && timeout --foreground --preserve-status --kill-after=120 2 '{}' explore "
                  "mass.toml --starts 999 --output stopped >/dev/null 2>&1",
                  folder().string(), program.string())
          .c_str());
  EXPECT_EQ(WEXITSTATUS(status), exit_nothing_saved);
}

TEST_F(CommandLine, SweepSolvesItsFinalistsOnAFinerGridUnlessToldNot) {
  std::ofstream(folder() / "case.toml") << small_case(2);
  const Outcome rough =
      wheelwright("sweep case.toml load.mass=200,300 --output sweep --without-errors", folder());
  EXPECT_EQ(rough.code, exit_done) << rough.output;
  EXPECT_FALSE(std::filesystem::exists(folder() / "sweep/designs/001.finer.json"));
  EXPECT_EQ(rough.output.find("+-"), std::string::npos) << rough.output;
  const Outcome fine = wheelwright("sweep case.toml load.mass=200,300 --output sweep", folder());
  EXPECT_EQ(fine.code, exit_done) << fine.output;
  for (const char* name : {"001", "002"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "sweep/designs" / fmt::format("{}.finer.json", name)));
  EXPECT_NE(fine.output.find("+-"), std::string::npos) << fine.output;
  // The program states the expected time first.
  EXPECT_LT(fine.output.find("takes about"), fine.output.find("16 x 192 cells")) << fine.output;
}

TEST_F(CommandLine, FolderInUseIsRefusedWithItsProcess) {
  const auto held = FolderLock::acquire(folder() / "designs");
  ASSERT_TRUE(held);
  for (const char* command : {"explore", "sweep"}) {
    const Outcome outcome =
        wheelwright(fmt::format("{} {} {} --output designs", command, path_of_case("cases/holes16.toml"),
                                command == std::string("sweep") ? "load.mass=100,200" : "--starts 2"),
                    folder());
    EXPECT_EQ(outcome.code, exit_refused) << outcome.output;
    EXPECT_NE(outcome.output.find(fmt::format("process {}", ::getpid())), std::string::npos)
        << outcome.output;
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "designs" / "settings.txt"));
}

// 14 x 192 cells have 12 columns per sector: 8 positions stand between them. check warns where that matters.
TEST_F(CommandLine, PositionsNeedNotStandOnColumns) {
  std::string text =
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.034\n"
      "[grid]\nradial_cells = 14\nangular_cells = 192\n[optimizer]\niterations = 2\ntread_band = 0.02\n";
  std::ofstream(folder() / "energy.toml") << text;
  std::ofstream(folder() / "even.toml") << text + "[objective]\nuniformity_dual = 10\n";
  const char* warning = "between columns";
  EXPECT_EQ(wheelwright("check energy.toml", folder()).output.find(warning), std::string::npos);
  EXPECT_NE(wheelwright("check even.toml", folder()).output.find(warning), std::string::npos);
  for (const char* name : {"energy", "even"}) {
    const Outcome verified = wheelwright(fmt::format("verify {}.toml", name), folder());
    EXPECT_EQ(verified.code, exit_done) << verified.output;
    const Outcome ran = wheelwright(fmt::format("run {0}.toml --output {0}", name), folder());
    EXPECT_EQ(ran.code, exit_done) << ran.output;
    EXPECT_EQ(wheelwright(fmt::format("resume {} --iterations 3", name), folder()).code, exit_done);
  }
}

// Where the rule on cut cells is too coarse for the test, one that is not shows the gradient's order.
TEST_F(CommandLine, VerifyUsesTheQuadratureOfARun) {
  std::ofstream(folder() / "coarse.toml") << R"([[holes.ring]]
count = 16
center_radius = 0.255
radius = 0.03
[grid]
radial_cells = 7
angular_cells = 112
[optimizer]
rim_band = 0.02
tread_band = 0.04
[load]
positions = 1
)";
  const Outcome outcome = wheelwright("verify coarse.toml", folder());
  EXPECT_EQ(outcome.code, exit_done) << outcome.output;
}

// A drawing or a saved shape in place of a case is recognized by its name: one line says what to do.
TEST_F(CommandLine, FilesThatAreNoCasesAreRefusedInOneLine) {
  for (const char* file : {"wheel.svg", "wheel.dxf", "shape.levelset"}) {
    std::ofstream(folder() / file) << "0\nSECTION\n";
    const Outcome outcome = wheelwright(fmt::format("check {}", file), folder());
    EXPECT_EQ(outcome.code, exit_usage) << file;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

TEST_F(CommandLine, BugExitsWithCode1) {
  EXPECT_EQ(guarded("test", []() -> int { throw std::logic_error("a bug"); }), exit_bug);
}

constexpr const char* case_beyond_any_memory = R"([wheel]
sectors = 1
[load]
positions = 1000
[grid]
radial_cells = 10000
angular_cells = 10000
)";

TEST_F(CommandLine, CaseBeyondMemoryIsRefusedBeforeWriting) {
  std::ofstream(folder() / "huge.toml") << case_beyond_any_memory;
  EXPECT_EQ(wheelwright("check huge.toml", folder()).code, exit_done);
  for (const char* command : {"run huge.toml", "analyze huge.toml --output out --positions 1000",
                              "verify huge.toml", "run huge.toml --output out"})
    EXPECT_EQ(wheelwright(command, folder()).code, exit_refused) << command;
  std::filesystem::remove(folder() / "huge.toml");
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

/// Peak memory of the largest program that this test has run so far [bytes].
double peak_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  constexpr double kibibyte = 1024;
  return static_cast<double>(usage.ru_maxrss) * kibibyte;
}

TEST_F(CommandLine, TheEstimateOfTheMemoryIsRightToAQuarter) {
  const std::string holes =
      "[load]\npositions = 8\n[output]\nerrors = \"none\"\n[[holes.ring]]\ncount = 16\ncenter_radius = "
      "0.27\nradius = "
      "0.04\n";
  int run_number = 0;
  for (const char* sections :
       {"[grid]\nradial_cells = 28\nangular_cells = 384\n",
        "[grid]\nradial_cells = 56\nangular_cells = 768\n",
        "[wheel]\nsectors = 1\n[grid]\nradial_cells = 28\nangular_cells = 384\n"}) {  // each takes more
    std::ofstream(folder() / "case.toml") << sections << holes;
    const double estimate = estimated_memory(problem_size(*read_case(folder() / "case.toml").value));
    const Outcome run =
        wheelwright(fmt::format("run case.toml --iterations 0 --output {}", ++run_number), folder());
    ASSERT_EQ(run.code, exit_done) << run.output;
    EXPECT_GT(estimate / peak_of_children(), 1 / 1.25) << sections;
    EXPECT_LT(estimate / peak_of_children(), 1.25) << sections;
  }
}

TEST_F(CommandLine, TheEstimateOfTheMemoryOfLargeDeformationIsRightToAQuarter) {
  const std::string wheel =
      "[material]\nyoungs_modulus = 8e6\nmodel = \"neo_hookean\"\n[load]\nforce = 1500\npositions = "
      "2\n[optimizer]\nrim_band = 0.0101\ntread_band = 0.0201\n[output]\nerrors = "
      "\"none\"\n[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.03\n";
  for (const char* grid : {"radial_cells = 14\nangular_cells = 192\n",
                           "radial_cells = 28\nangular_cells = 384\n"}) {  // each takes more
    std::ofstream(folder() / "case.toml") << wheel << "[grid]\n" << grid;
    const double estimate = estimated_memory(problem_size(*read_case(folder() / "case.toml").value));
    const Outcome run = wheelwright(
        fmt::format("run case.toml --iterations 0 --output {}", std::string(grid).substr(15, 2)), folder());
    ASSERT_EQ(run.code, exit_done) << run.output;
    EXPECT_GT(estimate / peak_of_children(), 1 / 1.25) << grid;
    EXPECT_LT(estimate / peak_of_children(), 1.25) << grid;
  }
}

TEST_F(CommandLine, InitWritesACaseThatChecksAndNeverOverwrites) {
  const std::string file = in_folder("new.toml");
  EXPECT_EQ(wheelwright("init " + file).code, exit_done);
  EXPECT_EQ(wheelwright("check " + file).code, exit_done);
  std::ofstream(folder() / "new.toml") << "mine";
  EXPECT_EQ(wheelwright("init " + file).code, exit_refused);
  std::ifstream in(folder() / "new.toml");
  std::string text;
  std::getline(in, text);
  EXPECT_EQ(text, "mine");
}

/// A small wheel with the same expectation of its initial and its last shape, whose J_e is that of one run.
std::string case_that_expects(double energy, const char* margin) {
  std::string text =
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.028\n"
      "[grid]\nradial_cells = 7\nangular_cells = 128\n[optimizer]\nrim_band = 0.02\ntread_band = 0.04\n"
      "iterations = 1\n";
  for (const char* iteration : {"iteration = 0\n", ""})
    text += fmt::format("[[expect]]\nquantity = \"strain_energy\"\nvalue = {}\nmargin = {}\n{}", energy,
                        margin, iteration);
  return text;
}

TEST_F(CommandLine, UnmetExpectationExitsWithCode7) {
  const auto run = [&](const std::string& name, const std::string& text, const std::string& options) {
    std::ofstream(folder() / (name + ".toml")) << text;
    return wheelwright(
        fmt::format("run {} --output {} {}", in_folder(name + ".toml"), in_folder(name), options));
  };
  ASSERT_EQ(run("any", case_that_expects(1, "0.5"), "").code, exit_unexpected);
  std::ifstream history(folder() / "any/history.csv");
  std::string header, first;
  std::getline(history, header);
  std::getline(history, first);
  ASSERT_TRUE(first.starts_with("0,0,1,,")) << first;
  const double energy = std::stod(first.substr(7));

  EXPECT_EQ(run("wide", case_that_expects(energy, "0.5"), "").code, exit_done);
  EXPECT_EQ(run("narrow", case_that_expects(energy, "1e-9"), "").code, exit_unexpected) << "the last shape";
  EXPECT_EQ(run("first", case_that_expects(energy, "1e-9"), "--iterations 0").code, exit_done);
  EXPECT_EQ(run("wrong", case_that_expects(1.001 * energy, "1e-4"), "--iterations 0").code, exit_unexpected);
  for (const char* file : {"comparison.svg", "rolling.pvd"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "wrong" / file)) << file;

  const auto resume = [&](const char* name) { return wheelwright("resume " + in_folder(name)).code; };
  EXPECT_EQ(resume("wide"), exit_done);
  EXPECT_EQ(resume("narrow"), exit_unexpected) << "the last shape";
  EXPECT_EQ(resume("first"), exit_done);
  EXPECT_EQ(resume("wrong"), exit_unexpected);
}

TEST_F(CommandLine, WithoutVtuNoFieldsAreWritten) {
  std::ofstream(folder() / "plain.toml") << case_that_expects(1, "1") + "[output]\nvtu_every = 0\n";
  wheelwright(fmt::format("run {} --output {}", in_folder("plain.toml"), in_folder("plain")));
  ASSERT_TRUE(std::filesystem::exists(folder() / "plain/comparison.svg"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / "plain")) {
    const std::string extension = entry.path().extension().string();
    EXPECT_TRUE(extension != ".vtu" && extension != ".pvd") << entry.path();
  }
}

/// Two rings of holes with thin spokes between them, on a coarse grid.
std::string case_with_thin_spokes(const char* volume, double step) {
  return fmt::format(
      "[[holes.ring]]\ncount = 32\ncenter_radius = 0.245\nradius = 0.017\n"
      "[[holes.ring]]\ncount = 32\ncenter_radius = 0.29\nradius = 0.022\n"
      "[grid]\nradial_cells = 14\nangular_cells = 192\n[load]\npositions = 2\n"
      "[volume]\n{}\n[optimizer]\niterations = 12\nstep = {}\ntread_band = 0.02\n",
      volume, step);
}

/// The pieces of material of a level set file; 0 when it cannot be read.
std::size_t n_pieces(const std::filesystem::path& file) {
  const auto psi = parse_level_set_file<2>(content(file));
  if (!psi) return 0;
  const auto found = components(*psi).all;
  return std::ranges::count_if(found, [](const auto& piece) { return piece.is_material; });
}

// Far too little material is asked for: the holes grow until there is nothing left that holds the tread.
TEST_F(CommandLine, GivingUpExitsWithCode3AndLeavesAReport) {
  std::ofstream(folder() / "c.toml") << case_with_thin_spokes("control = \"paper\"\ntarget = 0.24", 1);
  const Outcome run = wheelwright(fmt::format("run {} --output {}", in_folder("c.toml"), in_folder("run")));
  EXPECT_EQ(run.code, exit_no_solution);
  EXPECT_NE(run.output.find((folder() / "run/failure/report.txt").string()), std::string::npos) << run.output;
  for (const char* file : {"report.txt", "rejected.svg", "case.toml"})
    EXPECT_FALSE(content(folder() / "run/failure" / file).empty()) << file;
  EXPECT_EQ(n_pieces(folder() / "run/failure/accepted.levelset"), 1u);
  EXPECT_GT(n_pieces(folder() / "run/failure/rejected.levelset"), 1u);
  EXPECT_NE(content(folder() / "run/history.csv").find("tread_cut_off"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder() / "run/comparison.svg"));
  EXPECT_EQ(wheelwright(fmt::format("check {}", in_folder("run/failure/case.toml"))).code, exit_done);
}

// It continues from the last accepted shape, tries the next as before and fails as before.
TEST_F(CommandLine, ResumedRunGivesUpInTheSameWay) {
  std::ofstream(folder() / "c.toml") << case_with_thin_spokes("control = \"paper\"\ntarget = 0.24", 1);
  ASSERT_EQ(wheelwright("run c.toml --output run", folder()).code, exit_no_solution);
  const auto before = results(folder() / "run");
  ASSERT_TRUE(before.contains("failure/report.txt"));
  std::filesystem::remove_all(folder() / "run/failure");
  const Outcome again = wheelwright("resume run", folder());
  EXPECT_EQ(again.code, exit_no_solution);
  EXPECT_NE(again.output.find("run/failure/report.txt"), std::string::npos) << again.output;
  EXPECT_EQ(results(folder() / "run"), before);
}

TEST_F(CommandLine, DisconnectedInitialShapeExitsWithCode3AndIsDrawn) {
  std::ofstream(folder() / "c.toml") << case_with_thin_spokes("target = 0.3\nrate = 1", 1);
  const Outcome run = wheelwright(fmt::format("run {} --output {}", in_folder("c.toml"), in_folder("run")));
  EXPECT_EQ(run.code, exit_no_solution);
  for (const char* file : {"report.txt", "rejected.svg", "rejected.levelset"})
    EXPECT_FALSE(content(folder() / "run/failure" / file).empty()) << file;
}

// With large steps every pair of holes joins, and reaches the band at the rim.
TEST_F(CommandLine, MergingHolesAreReportedOnTerminalAndInHistory) {
  std::ofstream(folder() / "c.toml") << case_with_thin_spokes("control = \"exact\"", 2);
  const Outcome run =
      wheelwright(fmt::format("run {} --output {} --verbose", in_folder("c.toml"), in_folder("run")));
  EXPECT_EQ(run.code, exit_done);
  const std::string history = content(folder() / "run/history.csv");
  for (const ShapeEventKind kind : {ShapeEventKind::holes_merged, ShapeEventKind::hole_at_rim_band})
    for (const std::string* text : {&run.output, &history})
      EXPECT_NE(text->find(to_string(kind)), std::string::npos) << *text;
}

TEST_F(CommandLine, PicturesAreDrawnAtTheGivenInterval) {
  std::ofstream(folder() / "c.toml") << small_case(3, "pictures_every = 2\n");
  ASSERT_EQ(wheelwright("run c.toml --output run", folder()).code, exit_done);
  for (const int shape : {0, 1, 2, 3})
    for (const char* picture :
         {"stress", "displacement", "mesh", "gradient", "extension", "corrected", "level_set"}) {
      const std::string file = fmt::format("run/shapes/shape_{:04}_{}.svg", shape, picture);
      EXPECT_EQ(std::filesystem::exists(folder() / file), shape % 2 == 0) << file;
    }
}

/// The fatigue of the shapes is that of all load cases, as in the pictures of the result.
TEST_F(CommandLine, ShapesHaveTheFatigueOfAllLoadCases) {
  const auto fields_of = [&](const std::string& run, const std::string& share) {
    std::ofstream(folder() / "c.toml")
        << small_case(0) +
               "[material]\nfatigue_measure = \"principal_strain\"\nfatigue_strain = 0.02\nfatigue_exponent "
               "= 4\n"
               "[[load.case]]\nname = \"rolling\"\n" +
               share + "[[load.case]]\nname = \"kerb\"\nmass = 400\n" + share;
    EXPECT_EQ(wheelwright("run c.toml --output " + run, folder()).code, exit_done);
    return content(folder() / run / "shapes/shape_0000.vtu");
  };
  EXPECT_NE(fields_of("first", "").find("\"fatigue_utilization"), std::string::npos);
  EXPECT_NE(fields_of("all", "distance_share = 0.5\n").find("\"fatigue_of_all_loads"), std::string::npos);
}

TEST_F(CommandLine, AnalyzeWritesOnlyToAGivenFolder) {
  const std::string analyze =
      "analyze " + path_of_case("cases/holes16.toml") + " --positions 3 --loads 3000,1000,1000";
  EXPECT_EQ(wheelwright(analyze).code, exit_done);
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
  const std::string with_output = analyze + " --output " + in_folder("a/b");
  EXPECT_EQ(wheelwright(with_output).code, exit_done);
  EXPECT_EQ(wheelwright(with_output).code, exit_refused);
  const Outcome json = wheelwright(analyze + " --json");
  std::ifstream file(folder() / "a/b/analysis.json");
  EXPECT_TRUE(json.output.ends_with(std::string(std::istreambuf_iterator<char>(file), {}))) << json.output;
  for (const char* plot : {"travel.svg", "force.svg", "peak_pressure.svg", "pressures.svg", "loads.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder() / "a/b" / plot)) << plot;
  EXPECT_EQ(wheelwright(analyze + " --output /proc/none").code, exit_input_output);
}

TEST_F(CommandLine, RedirectedOutputHasNoEscapeCodes) {
  EXPECT_EQ(wheelwright("check " + path_of_case("cases/holes16.toml")).output.find('\x1b'),
            std::string::npos);
}

/// What a program loads before main() is most of the time that it takes to start.
TEST_F(CommandLine, TheProgramLoadsFewLibraries) {
  setenv("LD_TRACE_LOADED_OBJECTS", "1", 1);
  const std::string libraries = wheelwright("").output;
  unsetenv("LD_TRACE_LOADED_OBJECTS");
  EXPECT_LT(std::ranges::count(libraries, '\n'), 40) << libraries;
}

// A stiffness that no wheel of this volume has, and one that every wheel has.
TEST_F(CommandLine, ViolatedBoundExitsWithCode9) {
  for (const bool can_be_kept : {false, true}) {
    std::ofstream(folder() / "bound.toml")
        << "[[holes.ring]]\ncount = 16\ncenter_radius = 0.265\nradius = 0.03\n"
           "[grid]\nradial_cells = 14\nangular_cells = 128\ntread_levels = 0\n"
           "[load]\npositions = 1\n"
           "[optimizer]\niterations = 1\nrim_band = 0.02\ntread_band = 0.02\n"
           "[[constraint]]\nquantity = \"stiffness\"\nat_least = "
        << (can_be_kept ? "1e6" : "1e12") << '\n';
    const std::string output = can_be_kept ? "kept" : "missed";
    const Outcome run = wheelwright(fmt::format("run bound.toml --output {}", output), folder());
    EXPECT_EQ(run.code, can_be_kept ? exit_done : exit_infeasible) << run.output;
    // The bound and its value are told beside the files of a run that is done.
    std::ifstream summary(folder() / output / "summary.json");
    const std::string text{std::istreambuf_iterator<char>(summary), {}};
    EXPECT_NE(text.find("\"stiffness\""), std::string::npos) << text;
  }
}

/// A wheel of two layers under two load cases, of which shares of the distance are driven.
const std::string wheel_with_shares = small_case(1, R"(
[material]
youngs_modulus = 200e6
poissons_ratio = 0.4
fatigue_measure = "crossland"
fatigue_limit = 2e6
fatigue_pressure_factor = 0.3
fatigue_exponent = 5
[[material.layer]]
name = "tyre"
inner_radius = 0.305
youngs_modulus = 60e6
poissons_ratio = 0.4
holes = "none"
fatigue_measure = "principal_strain"
fatigue_strain = 0.1
fatigue_exponent = 3
[[load.case]]
name = "rolling"
distance_share = 0.9
[[load.case]]
name = "heavy"
distance_share = 0.1
mass = 450
)");

TEST_F(CommandLine, TheLifeUnderAllLoadCasesIsInAllResults) {
  std::ofstream(folder() / "wheel.toml") << wheel_with_shares;
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text.substr(0, 4000);
  };
  const Outcome run = wheelwright("run wheel.toml", folder());
  ASSERT_EQ(run.code, exit_done) << run.output;
  has(run.output, "fatigue life of tyre in all load cases");
  has(run.output, "% by heavy");
  const std::string summary = content(folder() / "run/summary.json");
  for (const char* key : {"fatigue_life_m in all load cases", "fatigue_utilization of tyre in all load cases",
                          "damage_by_load_case of tyre", "fatigue_place in all load cases"})
    has(summary, key);
  has(content(folder() / "run/report.html"), "fatigue life of tyre in all load cases");
  has(content(folder() / "run/fatigue.svg"), "fatigue of all loads");
  has(wheelwright("compare wheel.toml run --positions 2 --without-errors", folder()).output,
      "fatigue life of tyre in all load cases");
  const std::string analyze = "analyze wheel.toml --positions 2 --without-errors --output out",
                    line = "fatigue utilization of tyre in all load cases";
  has(wheelwright(analyze, folder()).output, line);
  has(content(folder() / "out/analysis.json"), "fatigue_in_all_load_cases");
  has(content(folder() / "out/fatigue.svg"), "fatigue of all loads");
  EXPECT_EQ(wheelwright("analyze wheel.toml --positions 2 --without-errors --load-case heavy", folder())
                .output.find(line),
            std::string::npos);
}

}  // namespace
}  // namespace wheelwright::testing
