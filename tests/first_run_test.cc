#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/run/results/stop_text.h"

// What the program tells on the terminal, by the eyes of somebody who runs it for the first time.

namespace wheelwright::testing {
namespace {

using namespace std::string_literals;

struct Outcome {
  int code;
  std::vector<std::string> lines;  ///< of standard output and error, as a terminal or a log shows them
};

std::size_t n_lines_with(const Outcome& outcome, const std::string& text) {
  return std::ranges::count_if(outcome.lines,
                               [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

std::string text(const Outcome& outcome) { return fmt::format("{}", fmt::join(outcome.lines, "\n")); }

class FirstRun : public TemporaryFolder {
 protected:
  Outcome wheelwright(const std::string& arguments) const {
    const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
    const std::string command = fmt::format("cd '{}' && OPENBLAS_NUM_THREADS=1 timeout 300 '{}' {} 2>&1",
                                            folder().string(), program.string(), arguments);
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    char buffer[4096];
    while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, split(output, '\n')};
  }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder() / file) << text;
  }

  std::size_t n_rejected(const std::string& run) const {
    const auto rows = split(content(folder() / run / "history.csv"), '\n');
    const auto header = split(rows.front(), ',');
    const auto accepted = std::ranges::find(header, "accepted") - header.begin();
    return std::ranges::count_if(rows,
                                 [&](const std::string& row) { return split(row, ',')[accepted] == "0"; });
  }
};

/// A case of the small wheel with more keys of its optimizer.
std::string small_case_with(const std::string& keys) {
  std::string text = small_case(6);
  const std::string section = "[optimizer]\n";
  return text.insert(text.find(section) + section.size(), keys);
}

TEST_F(FirstRun, RejectedTrialsAreDetails) {
  write("case.toml", small_case_with("step = 10\n"));  // so long that a trial is rejected
  const Outcome brief = wheelwright("run case.toml --output brief");
  const Outcome verbose = wheelwright("run case.toml --output verbose --verbose");
  ASSERT_EQ(brief.code, exit_done) << text(brief);
  ASSERT_EQ(verbose.code, exit_done) << text(verbose);
  ASSERT_GE(n_rejected("brief"), 1u);
  EXPECT_EQ(n_lines_with(brief, "halved"), 0u) << text(brief);
  EXPECT_EQ(n_lines_with(verbose, "halved"), n_rejected("verbose")) << text(verbose);
  EXPECT_EQ(n_lines_with(verbose, "shape 3/6"), 1u) << text(verbose);
  // The run is over within seconds: one line at its beginning and one at its end.
  EXPECT_LE(n_lines_with(brief, "elapsed"), 3u) << text(brief);
  for (const char* file : {"brief/report.html", "brief/comparison.svg", "brief/shape.svg"})
    EXPECT_EQ(n_lines_with(brief, file), 1u) << file;
}

TEST_F(FirstRun, GoodEndIsNotReportedAsAFailure) {
  write("case.toml", small_case_with("step = 10\nmax_halvings = 0\n"));
  const Outcome outcome = wheelwright("run case.toml");
  EXPECT_EQ(outcome.code, exit_done) << text(outcome);
  ASSERT_GE(n_rejected("run"), 1u);
  for (const char* word : {"no_descent", "rejected", "fail", "halved"})
    EXPECT_EQ(n_lines_with(outcome, word), 0u) << text(outcome);
  EXPECT_EQ(n_lines_with(outcome, text(StopReason::no_descent)), 1u) << text(outcome);
  const Outcome again = wheelwright("resume run");
  EXPECT_EQ(n_lines_with(again, "no_descent"), 0u) << text(again);
}

// The wheel is 120 mm wide: per metre it would have 8.3 times this mass.
TEST_F(FirstRun, ProgressShowsTheMassOfTheTable) {
  write("case.toml", small_case(1) +
                         "[material]\ndensity = 1200\n[objective]\nminimize = \"mass\"\n"
                         "[[constraint]]\nquantity = \"stiffness\"\nat_least = 1e6\n");
  const Outcome outcome = wheelwright("run case.toml");
  const auto summary = nlohmann::json::parse(content(folder() / "run" / "summary.json"));
  const auto told = std::ranges::find_if(
      outcome.lines, [](const std::string& line) { return line.find("shape 0/") != std::string::npos; });
  ASSERT_NE(told, outcome.lines.end()) << text(outcome);
  const std::string before = "objective ";
  const char* number = told->c_str() + told->find(before) + before.size();
  char* unit = nullptr;
  EXPECT_NEAR(std::strtod(number, &unit), summary["before"]["mass_kg"].get<double>(), 1e-4);
  EXPECT_TRUE(std::string(unit).starts_with(" kg ")) << *told;
}

// A table that is longer than a buffer, with warnings on standard error.
TEST_F(FirstRun, WarningsAreOutsideTheTableAndNameTheirWheel) {
  // So thin a wheel under so small a load that the contact is narrower than a cell.
  write("one.toml", small_case(0) + "[material]\nyoungs_modulus = 2e11\n");
  write("two.toml", small_case(0) + "[material]\nyoungs_modulus = 1e11\n");
  const Outcome outcome = wheelwright("compare one.toml two.toml --positions 2");
  ASSERT_EQ(outcome.code, exit_done) << text(outcome);
  std::vector<std::size_t> warnings, numbers;
  for (std::size_t k = 0; k < outcome.lines.size(); ++k) {
    const std::string& line = outcome.lines[k];
    if (line.starts_with("warning:")) {
      warnings.push_back(k);
      EXPECT_TRUE(line.find("one.toml") != std::string::npos || line.find("two.toml") != std::string::npos)
          << line;
    }
    if (line.find(" [") != std::string::npos && !line.starts_with("warning:")) numbers.push_back(k);
  }
  ASSERT_GE(warnings.size(), 2u) << text(outcome);
  ASSERT_GE(numbers.size(), 5u) << text(outcome);
  for (const std::size_t k : warnings)
    EXPECT_TRUE(k < numbers.front() || k > numbers.back()) << text(outcome);
}

// Names that the system refuses to look at, in every place where a command takes one.
TEST_F(FirstRun, UnreadablePathsHaveAClearMessage) {
  write("case.toml", small_case(0));
  ASSERT_EQ(wheelwright("run case.toml").code, exit_done);
  const std::string long_name(300, 'n');
  fs::create_symlink("loop", folder() / "loop");
  for (const std::string& path : {long_name, "loop/x"s, "case.toml/x"s, "nowhere/x"s}) {
    write("from.toml", fmt::format("[wheel]\nsectors = 8\n[shape]\nfrom = \"{}\"\n", path));
    write("drawing.toml", fmt::format("[wheel]\nsectors = 8\n[[shape.file]]\npath = \"{}\"\n", path));
    std::vector<std::string> commands{
        "check from.toml",
        "check drawing.toml",
        "compare case.toml " + path,
        "sweep " + path + " load.mass=1,2",
        "run case.toml --output case.toml/" + path,
        "watch case.toml --no-browser --designs " + path,
        fmt::format("watch case.toml --no-browser --output watched{} --replay {}", path.size(), path)};
    for (const char* command : {"check", "run", "resume", "analyze", "verify", "export", "report", "explore",
                                "watch --no-browser", "run run --output case.toml/x/"})
      commands.push_back(fmt::format("{} {}", command, path));
    for (const std::string& command : commands) {
      const Outcome outcome = wheelwright(command);
      EXPECT_TRUE(outcome.code == exit_usage || outcome.code == exit_input_output)
          << command << outcome.code << text(outcome);
      EXPECT_FALSE(outcome.lines.empty()) << command;
      for (const char* word : {"filesystem", "iostream", "basic_", "std::", "what()", "bug"})
        EXPECT_EQ(n_lines_with(outcome, word), 0u) << command << text(outcome);
    }
  }
}

}  // namespace
}  // namespace wheelwright::testing
