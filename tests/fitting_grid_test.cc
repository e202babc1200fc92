#include "wheelwright/case/fitting_grid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

CaseResult read(const std::string& text) { return parse_case(text, "case.toml"); }

std::string with_sectors(int sectors, const std::string& more = "") {
  return fmt::format(
      "[wheel]\nsectors = {0}\n[[holes.ring]]\ncount = {0}\ncenter_radius = 0.27\nradius = 0.005\n{1}",
      sectors, more);
}

TEST(FittingGrid, EveryNumberOfSectorsHasAGrid) {
  for (int sectors = 1; sectors <= 100; ++sectors) {
    const CaseResult result = read(with_sectors(sectors));
    ASSERT_TRUE(result.value) << sectors << ": " << result.problems.front().text();
    const int cells = result.value->grid.angular_cells;
    EXPECT_EQ(cells % sectors, 0);
    EXPECT_LE(2 * std::abs(cells - 384), sectors);  // the nearest
  }
}

TEST(FittingGrid, GivenSizesAreKeptOrRefused) {
  const CaseResult refused = read(with_sectors(18, "[grid]\nangular_cells = 384\n"));
  ASSERT_FALSE(refused.value);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems.front().key, "grid.angular_cells");
  for (const char* fitting : {"378", "396"}) {
    EXPECT_NE(refused.problems.front().text().find(fitting), std::string::npos);
    EXPECT_TRUE(read(with_sectors(18, fmt::format("[grid]\nangular_cells = {}\n", fitting))).value);
  }
  EXPECT_EQ(read(with_sectors(16, "[grid]\nradial_cells = 42\n")).value->grid.radial_cells, 42);
}

TEST(FittingGrid, CoarseGridsHaveWholeCells) {
  for (int levels = 0; levels <= 3; ++levels)
    for (const int sectors : {5, 16, 18}) {
      const CaseResult result =
          read(with_sectors(sectors, fmt::format("[optimizer]\ncoarse_levels = {}\n", levels)));
      ASSERT_TRUE(result.value) << levels << ' ' << sectors << ": " << result.problems.front().text();
      EXPECT_TRUE(can_be_halved(*result.value, levels));
    }
}

TEST(FittingGrid, RowsMakeUpTheAnnulusAndAreNoThickerThanTheBands) {
  const CaseResult annulus = read(with_sectors(16, "[objective]\nuniformity_annulus = 1\nannulus = 0.007\n"));
  ASSERT_TRUE(annulus.value) << annulus.problems.front().text();
  const double rows = 0.007 / (0.14 / annulus.value->grid.radial_cells);
  EXPECT_NEAR(rows, std::round(rows), 1e-6);
  const CaseResult band = read(with_sectors(16, "[optimizer]\nrim_band = 0.004\n"));
  ASSERT_TRUE(band.value) << band.problems.front().text();
  EXPECT_EQ(band.value->grid.radial_cells, 35);  // 0.14 m in rows of 4 mm
}

TEST(FittingGrid, TheTemplateLeavesTheSizesToTheProgram) {
  std::string text = case_template();
  for (const std::string key : {"sectors = 16", "count = 16"}) {
    ASSERT_NE(text.find(key), std::string::npos);
    text.replace(text.find(key), key.size(), key.substr(0, key.size() - 2) + "18");
  }
  const CaseResult result = read(text);
  ASSERT_TRUE(result.value) << result.problems.front().text();
  EXPECT_EQ(result.value->grid.angular_cells % 18, 0);
}

TEST(Modulus, InMegapascalsIsSuspected) {
  const CaseResult result = read(with_sectors(16, "[material]\nyoungs_modulus = 25\n"));
  ASSERT_FALSE(result.value);
  EXPECT_EQ(result.problems.size(), 1u);
  EXPECT_EQ(result.problems.front().key, "material.youngs_modulus");
  EXPECT_EQ(result.problems.front().line, 8);
  EXPECT_NE(result.problems.front().text().find("25e6"), std::string::npos) << result.problems.front().text();
  EXPECT_TRUE(read(with_sectors(16, "[material]\nyoungs_modulus = 25e6\n[load]\nmass = 30\n")).value);
}

}  // namespace
}  // namespace wheelwright
