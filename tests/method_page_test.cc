#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
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
    const auto file = source / (path.find('/') == std::string::npos ? "tests" : "src") / path;
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
    const std::string code = contents(file);
    for (const auto& found : matches(names, name)) {
      EXPECT_NE(code.find(found[1]), std::string::npos) << path << ": " << found[1];
      ++checked;
    }
  }
  EXPECT_GT(checked, 40);
}

}  // namespace
}  // namespace wheelwright
