#include "wheelwright/case/points_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

using Points = std::vector<std::array<double, 2>>;

TEST(PointsFile, HasOnePointPerLineInTheWaysOfSpreadsheets) {
  const Points expected{{-0.1, 0}, {0, 2.5e-3}, {0.1, 0}};
  for (const char* text : {"-0.1,0\n0,2.5e-3\n0.1,0\n", "x,height\n-0.1, 0\n\n0, 0.0025\n+0.1, 0",
                           "\xef\xbb\xbfWeg;Hoehe\r\n-0,1;0\r\n0;0,0025\r\n0,1;0\r\n",
                           "# along, height in m\n-0.1 0\n0  2.5e-3\n0.1 0", "-0,1\t0\n0\t0,0025\n0,1\t0"}) {
    const auto points = parse_points(text);
    ASSERT_TRUE(points) << text;
    EXPECT_EQ(*points, expected) << text;
  }
}

TEST(PointsFile, NamesTheLineThatIsNoPoint) {
  const std::pair<const char*, int> texts[]{{"0,1\n\n2,x\n", 3}, {"a,b\nc,d\n0,1\n", 2}, {"1,2,3\n", 1},
                                            {"0,nan", 1},        {"0,1e999", 1},         {"5\n", 1}};
  for (const auto& [text, line] : texts) {
    const auto points = parse_points(text);
    ASSERT_FALSE(points) << text;
    EXPECT_EQ(points.failure().line, line) << text;
  }
}

/// A case that names one has its points, and is written with them: a run does not need the file any more.
TEST(PointsFile, GivesACaseItsPoints) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "points_file";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "step.csv") << "-0.2,0\n-0.05,0.001\n0.3,0.002\n";
  std::ofstream(folder / "step.toml")
      << "[load]\nforce = 100\nground = \"profile\"\nground_profile = \"step.csv\"\n";
  const CaseResult read = read_case(folder / "step.toml");
  ASSERT_TRUE(read.value) << read.problems.front().text();
  EXPECT_EQ(read.value->load.ground_profile, (Points{{-0.2, 0}, {-0.05, 0.001}, {0.3, 0.002}}));
  const CaseResult again = parse_case(to_toml(*read.value), "elsewhere/case.toml");
  ASSERT_TRUE(again.value);
  EXPECT_EQ(again.value->load, read.value->load);
}

TEST(PointsFile, ProblemsAreThoseOfItsKey) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "points_file";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "two.csv") << "0,0\n1,0\n";
  std::ofstream(folder / "far.csv") << "0,0\n1,0\n1e6,0\n";
  std::ofstream(folder / "words.csv") << "0,0\n1,zero\n2,0\n";
  const std::pair<const char*, Diagnostic::Kind> names[]{{"two.csv", Diagnostic::Kind::out_of_range},
                                                         {"far.csv", Diagnostic::Kind::out_of_range},
                                                         {"words.csv", Diagnostic::Kind::wrong_type},
                                                         {"missing.csv", Diagnostic::Kind::unreadable},
                                                         {"profile.txt", Diagnostic::Kind::wrong_type}};
  for (const auto& [name, kind] : names) {
    const CaseResult read = parse_case(
        std::string("[load]\nforce = 100\nground = \"profile\"\nground_profile = \"") + name + "\"\n",
        folder / "case.toml");
    ASSERT_EQ(read.problems.size(), 1) << name;
    EXPECT_EQ(read.problems[0].kind, kind) << read.problems[0].text();
    EXPECT_EQ(read.problems[0].key, "load.ground_profile");
    EXPECT_EQ(read.problems[0].line, 4);
  }
}

}  // namespace
}  // namespace wheelwright
