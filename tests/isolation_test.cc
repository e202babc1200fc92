#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"

// What a run takes from its surroundings, and what it leaves there: it writes only into its folder, shows a
// title as text, and knows no locale.

namespace wheelwright {
namespace {

namespace fs = std::filesystem;
using testing::content;
using testing::results;
using testing::small_wheel;
using testing::TemporaryFolder;

struct Outcome {
  int code;
  std::string output;
};

class Isolation : public TemporaryFolder {
 protected:
  Isolation() : top_(folder()), folder_(top_ / "here") { fs::create_directory(folder_); }

  /// Runs the program in folder_, with variables of the environment before its name.
  Outcome wheelwright(const std::string& arguments, const std::string& environment = "") const {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
    const std::string command =
        fmt::format("cd '{}' && {} '{}' {} 2>&1", folder_.string(), environment, program.string(), arguments);
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    for (int c; (c = std::fgetc(pipe)) != EOF;) output += static_cast<char>(c);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
  }

  void write_case(const std::string& file, const std::string& first_lines) const {
    std::ofstream(folder_ / file) << first_lines << small_wheel;
  }

  /// The names of the results that are not the same in two folders.
  static std::string differences(const fs::path& a, const fs::path& b) {
    const auto in_a = results(a), in_b = results(b);
    std::string names = in_a.empty() ? "no files" : "";
    for (const auto& [name, text] : in_a)
      if (!in_b.contains(name) || in_b.at(name) != text) names += name + "\n";
    for (const auto& [name, text] : in_b)
      if (!in_a.contains(name)) names += name + "\n";
    return names;
  }

  std::vector<std::string> names(const fs::path& folder) const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder))
      result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
  }

  const fs::path top_, folder_;
};

TEST_F(Isolation, RunWritesOnlyToItsFolder) {
  write_case("a.toml", "title = '../../up/\"/etc/x'\n");
  ASSERT_EQ(wheelwright("run a.toml --iterations 1").code, exit_done);
  EXPECT_EQ(names(folder_), (std::vector<std::string>{"a.toml", "runs"}));
  EXPECT_EQ(names(folder_ / "runs"), std::vector<std::string>{"a"});
  EXPECT_EQ(names(top_), std::vector<std::string>{"here"});
}

TEST_F(Isolation, NamesOfCaseFilesCannotEscapeTheFolder) {
  fs::create_directory(folder_ / "cases");
  for (const char* file :
       {"cases/...toml", "cases/b c;touch x;$(touch y).toml", "cases/\xff.toml", "cases/-.toml"}) {
    write_case(file, "");
    const std::string arguments = fmt::format("run --iterations 0 '{}'", (folder_ / file).string());
    const Outcome run = wheelwright(arguments);
    EXPECT_EQ(run.code, exit_done) << file << run.output;
    EXPECT_EQ(names(folder_), (std::vector<std::string>{"cases", "runs"})) << file;
    EXPECT_EQ(names(top_), std::vector<std::string>{"here"}) << file;
    EXPECT_EQ(wheelwright(fmt::format("analyze --json --positions 1 '{}'", (folder_ / file).string())).code,
              exit_done)
        << file;
  }
}

TEST_F(Isolation, TheFolderOfTheCommandLineIsNoPartOfTheResult) {
  write_case("a.toml", "");
  ASSERT_EQ(wheelwright("run a.toml --iterations 1").code, exit_done);
  ASSERT_EQ(wheelwright("run a.toml --iterations 1 --output ../other").code, exit_done);
  EXPECT_EQ(differences(folder_ / "runs/a", top_ / "other"), "");
  EXPECT_EQ(wheelwright("check ../other/case.toml").code, exit_done);
}

TEST_F(Isolation, ATitleIsTextWhereverItIsShown) {
  write_case("a.toml",
             "title = \"<script>alert('x')</script> & \\\" ]]> \\u001B[31m \\u009B \\uFFFE\\nline\"\n");
  ASSERT_EQ(wheelwright("run a.toml --iterations 0").code, exit_done);
  const Outcome table = wheelwright("analyze a.toml --positions 1 --output analysis");
  ASSERT_EQ(table.code, exit_done);
  EXPECT_EQ(table.output.find('\x1b'), std::string::npos);
  int titles = 0;
  for (const auto& [name, text] : results(folder_)) {
    if (!name.ends_with(".svg")) continue;
    EXPECT_EQ(text.find("<script"), std::string::npos) << name;
    EXPECT_EQ(text.find("]]>"), std::string::npos) << name;
    EXPECT_EQ(text.find("\xef\xbf\xbe"), std::string::npos) << name;
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << name;
    titles += text.find("&lt;script&gt;alert(&apos;x&apos;)") != std::string::npos;
  }
  EXPECT_GE(titles, 3);
}

/// A locale that writes a comma for the decimal point and groups digits, made in a folder; empty where the
/// system cannot make one.
std::string locale_with_comma(const fs::path& folder) {
  fs::create_directories(folder);
  const std::string made =
      fmt::format("localedef -i de_DE -f UTF-8 '{}' >/dev/null 2>&1", (folder / "de_DE.UTF-8").string());
  if (std::system(made.c_str()) == -1) return "";
  setenv("LOCPATH", folder.c_str(), 1);
  const bool works =
      std::setlocale(LC_ALL, "de_DE.UTF-8") && std::string_view(localeconv()->decimal_point) == ",";
  std::setlocale(LC_ALL, "C");
  unsetenv("LOCPATH");
  return works ? fmt::format("LOCPATH='{}' LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8", folder.string()) : "";
}

TEST_F(Isolation, ALocaleWithCommasGivesTheSameBytes) {
  const std::string german = locale_with_comma(top_ / "locales");
  if (german.empty()) GTEST_SKIP() << "no locale with decimal commas: install the package locales";
  write_case("a.toml", "");
  const std::string analysis = "analyze a.toml --positions 2 --loads 1000.5,2500.25 --json --output ";
  // On a slow machine check tells what it is doing.
  const auto without_stages = [](const std::string& output) {
    return std::regex_replace(output, std::regex("[^\n]* \\.\\.\\.\n"), "");
  };
  for (const char* command : {"check a.toml", "reference"})
    EXPECT_EQ(without_stages(wheelwright(command).output),
              without_stages(wheelwright(command, german).output))
        << command;
  ASSERT_EQ(wheelwright("run a.toml --iterations 2 --output plain").code, exit_done);
  ASSERT_EQ(wheelwright("run a.toml --iterations 2 --output german", german).code, exit_done);
  EXPECT_EQ(differences(folder_ / "plain", folder_ / "german"), "");
  EXPECT_EQ(wheelwright(analysis + "plain_analysis").output,
            wheelwright(analysis + "german_analysis", german).output);
  EXPECT_EQ(differences(folder_ / "plain_analysis", folder_ / "german_analysis"), "");
}

TEST(Shell, TheSourcesCallNone) {
  const std::regex calls(R"(\b(system|popen|wordexp|execl|execv\w*|posix_spawn\w*|setlocale)\s*\()");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(WHEELWRIGHT_SOURCE_DIR) / "src")) {
    // The program itself again, and a browser: neither by way of a shell.
    const bool starts_a_program =
        entry.path().filename() == "process_settings.cc" || entry.path().filename() == "open_browser.cc";
    if (!entry.is_regular_file() || starts_a_program) continue;
    std::smatch call;
    const std::string source = content(entry.path());
    EXPECT_FALSE(std::regex_search(source, call, calls)) << entry.path() << ": " << call.str();
  }
}

}  // namespace
}  // namespace wheelwright
