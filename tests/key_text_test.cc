#include "wheelwright/case/key_text.h"

#include <gtest/gtest.h>

#include "wheelwright/case/key_paths.h"
#include "wheelwright/case/presets.h"
#include "wheelwright/case/read.h"

// Keys of cases by their paths, as programs read and set them.

namespace wheelwright {
namespace {

const std::string wheel = R"(# A wheel
[wheel]
sectors = 8  # eight
[load]
mass = 25
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.03
)";

Case case_of(const std::string& text) {
  const auto read = parse_case(text, "case.toml");
  for (const auto& problem : read.problems) ADD_FAILURE() << problem.text();
  return *read.value;
}

std::string with(const std::string& path, const std::string& value, const std::string& given = wheel) {
  const auto result = with_key(given, path, value);
  if (!result) ADD_FAILURE() << result.failure().text;
  return result ? *result : "";
}

TEST(KeyText, IsTheValueInTheUnitOfTheFile) {
  const Case c = case_of(wheel);
  EXPECT_EQ(*key_text(c, "wheel.sectors"), "8");
  EXPECT_EQ(*key_text(c, "load.mass"), "25");
  EXPECT_EQ(*key_text(c, "holes.ring[1].radius"), "0.03");
  EXPECT_EQ(*key_text(c, "material.plane"), "\"strain\"");
  EXPECT_EQ(*key_text(c, "load.travel"), "");
}

TEST(KeyText, OfAnUnknownKeyIsAProblemThatNamesASimilarOne) {
  const auto unknown = key_text(case_of(wheel), "wheel.sector");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.failure().text.find("wheel.sectors"), std::string::npos);
  EXPECT_FALSE(with_key(wheel, "load.mess", "3"));
  EXPECT_FALSE(with_key(wheel, "holes.ring[3].radius", "0.02"));
  EXPECT_FALSE(with_key(wheel, "holes.ring[x].radius", "0.02"));
}

/// Every key of every preset, set to its own value in its own text, gives the same case.
TEST(KeyText, OfEveryKeyComesBack) {
  for (const Preset& preset : presets()) {
    const Case c = case_of(std::string(preset.text));
    for (const char* path :
         {"wheel.sectors", "load.positions", "grid.radial_cells", "grid.angular_cells", "contact.friction",
          "optimizer.iterations", "material.youngs_modulus", "title"}) {
      const auto value = key_text(c, path);
      ASSERT_TRUE(value) << path;
      EXPECT_EQ(case_of(with(path, *value, std::string(preset.text))), c) << preset.name << " " << path;
    }
  }
}

TEST(KeyText, IsReplacedInPlace) {
  EXPECT_EQ(with("wheel.sectors", "16").find("sectors = 16  # eight"), wheel.find("sectors = 8"));
  EXPECT_EQ(case_of(with("holes.ring[1].radius", "0.02")).holes.rings.front().radius, 0.02);
}

TEST(KeyText, ReplacesItsAlternatives) {
  const std::string changed = with("load.force", "600");
  EXPECT_EQ(changed.find("mass"), std::string::npos);
  EXPECT_EQ(*key_text(case_of(changed), "load.force"), "600");
  EXPECT_EQ(case_of(with("load.mass", "25", changed)), case_of(wheel));
}

TEST(KeyText, AddsTablesAndRemovesKeys) {
  EXPECT_EQ(*key_text(case_of(with("contact.friction", "0.3")), "contact.friction"), "0.3");
  EXPECT_EQ(*key_text(case_of(with("title", "\"ä wheel\"")), "title"), "\"ä wheel\"");
  std::string two = with("holes.ring[2].count", "8");
  two = with("holes.ring[2].center_radius", "0.22", two);
  two = with("holes.ring[2].radius", "0.01", two);
  EXPECT_EQ(case_of(two).holes.rings.size(), 2);
  EXPECT_EQ(case_of(two).holes.rings.front().count, 16);
  EXPECT_EQ(with("wheel.sectors", "").find("sectors"), std::string::npos);
  EXPECT_EQ(with("load.travel", ""), wheel);
}

/// A table that only its parts imply, and one that stands in a line.
TEST(KeyText, AddsTheTableThatOthersImply) {
  const std::string term = "[[objective.term]]\nquantity = \"travel\"\nweight = 200\n";
  const Case c = case_of(with("objective.strain_energy", "0.5", wheel + term));
  EXPECT_EQ(*key_text(c, "objective.strain_energy"), "0.5");
  EXPECT_EQ(c.objective.terms.size(), 1);
  const std::string spaced = "[ contact ] # ground\ngamma_0 = 20\n" + wheel;
  EXPECT_EQ(*key_text(case_of(with("contact.friction", "0.3", spaced)), "contact.gamma_0"), "20");
  EXPECT_FALSE(with_key("contact = {gamma_0 = 20}\n" + wheel, "contact.friction", "0.3"));
}

TEST(KeyText, FindsPlacesBehindLettersOfSeveralBytes) {
  const std::string accented = "title = \"Räder\" # größer\n" + wheel;
  EXPECT_EQ(case_of(with("title", "\"x\"", accented)).title, "x");
  EXPECT_EQ(case_of(with("load.mass", "30", accented)).title, "Räder");
}

}  // namespace
}  // namespace wheelwright
