#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace wheelwright {
namespace {

const std::filesystem::path source(WHEELWRIGHT_SOURCE_DIR);

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The section of docs/method.md that leads from equations to functions.
std::string equations() {
  const std::string page = contents(source / "docs" / "method.md");
  const auto begin = page.find("\n## From equations to functions"), end = page.find("\n## ", begin + 1);
  return page.substr(begin, end - begin);
}

/// They refer to `text`, which must live on.
std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// The second cells of those rows of docs/verification.md whose table calls them "test".
std::vector<std::string> test_cells() {
  std::istringstream page(contents(source / "docs" / "verification.md"));
  static const std::regex second_cell(R"(\|[^|]*\| *((?:[^|\\]|\\.)*?) *\|.*)");
  std::vector<std::string> cells;
  bool is_of_tests = false;
  std::string line;
  for (std::smatch row; std::getline(page, line);) {
    if (!std::regex_match(line, row, second_cell))
      is_of_tests = false;
    else if (row[1] == "test")
      is_of_tests = true;
    else if (is_of_tests && row[1].str().find_first_not_of('-') != std::string::npos)
      cells.push_back(row[1]);
  }
  return cells;
}

/// The tests of a source file by their suites.
std::map<std::string, std::set<std::string>> tests_of(const std::filesystem::path& file) {
  static const std::regex test(R"(\n(?:TYPED_)?TEST(?:_F|_P)?\((\w+), (\w+)\))");
  std::map<std::string, std::set<std::string>> suites;
  const std::string code = contents(file);
  for (const auto& match : matches(code, test)) suites[match[1]].insert(match[2]);
  return suites;
}

TEST(MethodPage, EveryNumberedEquationOfThePaperHasAPlace) {
  const std::string text = equations();
  std::set<int> named;
  static const std::regex range("\\(([0-9]+)\\)(?: to \\(([0-9]+)\\))?");
  for (const auto& match : matches(text, range)) {
    const int first = std::stoi(match[1]), last = match[2].matched ? std::stoi(match[2]) : first;
    for (int equation = first; equation <= last; ++equation) named.insert(equation);
  }
  constexpr int last_of_the_paper = 83;
  for (int equation = 1; equation <= last_of_the_paper; ++equation)
    EXPECT_TRUE(named.contains(equation)) << equation;
}

TEST(MethodPage, EveryFileExistsAndHoldsTheNamesThatFollowIt) {
  const std::string text = equations();
  static const std::regex place(
      "`([a-z_/0-9]+\\.(?:cc|h))`((?:(?:: |, )(?:constructor of )?`[A-Za-z_:]+`)*)"),
      name("`(?:[A-Za-z_]+::)?([A-Za-z_]+)`");
  int checked = 0;
  for (const auto& match : matches(text, place)) {
    const std::string path = match[1], names = match[2];
    const auto file = source / (path.find('/') == std::string::npos ? "tests" : "src/wheelwright") / path;
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
    const std::string code = contents(file);
    for (const auto& found : matches(names, name)) {
      EXPECT_NE(code.find(found[1]), std::string::npos) << path << ": " << found[1];
      ++checked;
    }
  }
  EXPECT_GT(checked, 40);
}

/// A cell names files, suites of the file before them, tests with their suite, or more tests of the same
/// suite.
TEST(VerificationPage, EveryTestThatItNamesExists) {
  static const std::regex name(R"(`([\w/-]+(?:\.\w+)?)`|\b(?:([A-Z]\w*)\.)?([A-Z]\w*)|\b(same|both)\b)");
  std::map<std::string, std::set<std::string>> tests;
  std::string suite;
  int checked = 0;
  for (const std::string& cell : test_cells()) {
    const auto names = matches(cell, name);
    EXPECT_FALSE(names.empty()) << cell;
    for (const auto& match : names) {
      if (match[1].matched) {
        const std::string path = match[1];
        const auto file = source / (path.find('/') == std::string::npos ? "tests" : "") / path;
        EXPECT_TRUE(std::filesystem::exists(file)) << file;
        tests = tests_of(file);
      } else if (match[3].matched) {
        if (match[2].matched) suite = match[2];
        EXPECT_TRUE(tests[suite].contains(match[3]) || (!match[2].matched && tests.contains(match[3])))
            << suite << ": " << match[0];
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 90);
}

}  // namespace
}  // namespace wheelwright
