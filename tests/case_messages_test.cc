#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <random>

#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/read.h"
#include "wheelwright/run/study/case_report.h"

// What a case's problems say, beyond their line and kind, where only the right hint helps.

namespace wheelwright {
namespace {

/// "line:column value problem; remedy" of all problems of a text.
std::string problems_of(std::string_view text) {
  std::string result;
  for (const Diagnostic& d : parse_case(text, "case.toml").problems)
    result += fmt::format("{}:{} {} {}; {}\n", d.line, d.column, d.value, d.problem, d.remedy);
  return result;
}

bool says(std::string_view text, std::string_view words) {
  return problems_of(text).find(words) != std::string::npos;
}

using Place = std::pair<int, int>;

Place first_place(std::string_view text) {
  const Diagnostic d = parse_case(text, "case.toml").problems.front();
  return {d.line, d.column};
}

TEST(CaseMessages, UnterminatedStringIsReportedAtItsStart) {
  for (const std::string quotes : {"\"\"\"", "\'\'\'"}) {
    EXPECT_EQ(
        first_place("[wheel]\nsectors = 8\n[output]\nfolder = " + quotes + "runs\n\n[load]\nmass = 1\n"),
        Place(4, 10));
    EXPECT_EQ(first_place("title = " + quotes + "a" + quotes + "\n[output]\nfolder = " + quotes + "runs"),
              Place(3, 10));
    EXPECT_EQ(first_place("title = " + quotes), Place(1, 9));
  }
  for (const std::string quote : {"\"", "'"}) {
    EXPECT_EQ(first_place("title = 'x' # it's\n[output]\nfolder = " + quote + "runs\n[wheel]\nsectors = 8\n"),
              Place(3, 10));
    EXPECT_EQ(first_place("title = " + quote), Place(1, 9));
  }
  // The line's mistake is another one.
  EXPECT_EQ(first_place("title = \"gr\xc3\xbc\xc3\x9f\"\nwheel = [\"\xc3\xbc\", \"b\n"), Place(2, 15));
  EXPECT_FALSE(says("title = it's\n", "no end"));
  EXPECT_FALSE(says("title = \"a\\qb\"\n", "no end"));
  EXPECT_FALSE(says("[wheel]\nwidth = 1 m # it's\n", "no end"));
}

TEST(CaseMessages, OtherEncodingsAreNamed) {
  const std::string text = "[wheel]\nsectors = 8\n";
  const auto wide = [&](int width, bool little_endian) {
    std::string bytes;
    for (const char c : text) {
      std::string unit(width, '\0');
      unit[little_endian ? 0 : width - 1] = c;
      bytes += unit;
    }
    return bytes;
  };
  for (const std::string& bytes : {"\xff\xfe" + wide(2, true), "\xfe\xff" + wide(2, false), wide(2, true),
                                   wide(2, false), std::string("\xff\xfe\0\0", 4) + wide(4, true)}) {
    const auto problems = parse_case(bytes, "case.toml").problems;
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].problem.find("UTF-"), std::string::npos);
    EXPECT_NE(problems[0].remedy.find("UTF-8"), std::string::npos);
  }
  EXPECT_TRUE(parse_case("\xef\xbb\xbf" + text, "case.toml").value);
  EXPECT_TRUE(says("title = \"gr\xfc\xdf\"\n", "as UTF-8"));
}

TEST(CaseMessages, ValuesArePrintedInNaturalForm) {
  EXPECT_TRUE(says("[wheel]\nsectors = 0.1\n", "2:11 0.1 "));
  EXPECT_TRUE(says("[wheel]\nsectors = 16.0\n", "2:11 16.0 "));
  EXPECT_TRUE(says("[wheel]\nwidth = -0.3\n", "2:9 -0.3 "));
  EXPECT_TRUE(says("[load]\nbody_force = [0.1, 0.7, 3]\n", "[0.1, 0.7, 3] "));
  EXPECT_TRUE(says("[wheel]\nwidth = nan\n", "2:9 nan "));
  EXPECT_TRUE(says("[wheel]\nwidth = -inf\n", "2:9 -inf "));
}

TEST(CaseMessages, LengthsInMillimetresAreRecognized) {
  EXPECT_TRUE(says("[wheel]\nouter_radius = 3400\n", "write 3.4"));
  EXPECT_TRUE(says("[wheel]\ninner_radius = 200\n", "write 0.2"));
  EXPECT_TRUE(says("[load]\ntravel = 3\n", "write 0.003"));
  EXPECT_TRUE(says("[optimizer]\nrim_band = 5\n", "write 0.005"));
  const std::string ring = "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = ";
  EXPECT_TRUE(says(ring + "30\n", "write 0.03"));
  EXPECT_TRUE(says(ring + "300\n", "write 0.3"));
  EXPECT_TRUE(says(ring + "0.03\n[wheel]\nouter_radius = 340\n", "if 340 is in mm, write 0.34"));
  // Numbers that are no millimetres, and numbers of other units.
  EXPECT_FALSE(says(ring + "0.3\n", "mm"));
  EXPECT_FALSE(says("[wheel]\nwidth = -120\n", "mm"));
  EXPECT_FALSE(says("[contact]\nfriction = 300\n", "mm"));
}

TEST(CaseMessages, WheelOfHundredsOfMetresGivesAWarning) {
  Case c;
  const auto doubts = [&] {
    return std::ranges::count_if(warnings(c), [](const std::string& text) {
      return text.find("lengths are in metres") != std::string::npos;
    });
  };
  EXPECT_EQ(doubts(), 0);
  c.wheel.width = 120;
  EXPECT_EQ(doubts(), 1);
  c.wheel.inner_radius = 200;
  c.wheel.outer_radius = 340;
  EXPECT_EQ(doubts(), 1) << "the width fits the radius";
}

// The middle of a slab that both faces cool is warmer than they are by h w / (4 k) of their rise.
TEST(CaseWarnings, OfTemperaturesThatVaryOverTheWidth) {
  Case c;
  c.wheel.width = 0.05;
  c.material.conductivity = 0.2;
  c.heat.convection = 10;
  const auto told = [&] {
    for (const std::string& text : warnings(c))
      if (text.find("in the middle of the width") != std::string::npos) return text;
    return std::string();
  };
  EXPECT_NE(told().find("up to 62 % more"), std::string::npos) << told();
  c.heat.side_convection = 0;
  EXPECT_EQ(told(), "");
  c.heat.side_convection = 10;
  c.material.conductivity = 20;
  EXPECT_EQ(told(), "");
}

// In a freezer; the rim is warmer than the air, or colder.
TEST(CaseMessages, TemperaturesMayBeBelowZeroButNotBelowWhatWarmsTheWheel) {
  const auto wheel = [](const char* rim, const char* bound) {
    return fmt::format(
        "[load]\nspeed = 5\n[material]\ndensity = 1100\nloss_factor = 0.1\nconductivity = 0.3\n"
        "[[holes.ring]]\ncount = 16\ncenter_radius = 0.26\nradius = 0.03\n"
        "[heat]\nambient_temperature = -30\nconvection = 20\n{}"
        "[[expect]]\nquantity = \"peak_temperature\"\nvalue = -10\n"
        "[[constraint]]\nquantity = \"peak_temperature\"\n{}",
        rim, bound);
  };
  const auto accepts = [&](const char* rim, const char* bound) {
    const std::string problems = problems_of(wheel(rim, bound));
    EXPECT_TRUE(problems.empty() || problems.find("no shape can meet it: heat.") != std::string::npos)
        << problems;
    return problems.empty();
  };
  const char *insulated = "", *warm = "rim_temperature = -5\n", *cold = "rim_temperature = -40\n";
  EXPECT_TRUE(accepts(insulated, "at_most = -29"));
  EXPECT_TRUE(accepts(insulated, "at_least = 0"));
  EXPECT_TRUE(accepts(insulated, "at_least = -40"));
  EXPECT_FALSE(accepts(insulated, "at_most = \"-30 deg C\""));
  EXPECT_FALSE(accepts(insulated, "equals = -31"));
  EXPECT_FALSE(accepts(warm, "at_most = -6"));
  EXPECT_TRUE(accepts(warm, "at_most = -4"));
  EXPECT_TRUE(accepts(cold, "at_most = -35")) << "the cold rim may cool all of the wheel";
  EXPECT_FALSE(accepts(cold, "at_most = -40"));
  EXPECT_NE(problems_of(wheel(cold, "at_most = -40")).find("heat.rim_temperature = -40"), std::string::npos);
  // A layer that does not reach the rim may be colder than it.
  const std::string layer =
      "layer = \"tyre\"\n[[material.layer]]\nname = \"tyre\"\ninner_radius = 0.3\n"
      "youngs_modulus = 2e8\npoissons_ratio = 0.35\n"
      "density = 1100\nloss_factor = 0.1\nconductivity = 0.3\n";
  EXPECT_TRUE(accepts(warm, ("at_most = -6\n" + layer).c_str()));
  EXPECT_FALSE(accepts(warm, ("at_most = -30\n" + layer).c_str()));
}

TEST(CaseMessages, NameThePairOfALossFactor) {
  const auto of = [](const std::string& table) {
    return problems_of("[load]\nspeed = 5\n[material]\ndensity = 1100\nloss_factor = " + table + "\n");
  };
  EXPECT_NE(of("[[1, 0.1], [10, 0.2], [100, 700.0]]").find("pair 3: the loss factor 700.0"),
            std::string::npos);
  EXPECT_NE(of("[[1, 0.1], [-10, 0.2]]").find("pair 2: the frequency -10"), std::string::npos);
  EXPECT_NE(of("[[1, 0.1], [10]]").find("entry 2, [10]"), std::string::npos);
  EXPECT_NE(of("[[1, 0.1], [10, 0.2], [5, 0.3]]").find("pair 3"), std::string::npos);
  EXPECT_EQ(of("[[1, 0.1], [10, 0.2]]"), "");
}

TEST(CaseWarnings, OfConstantsOfHeatWithoutASectionHeat) {
  Case c;
  const auto is_told = [&](const std::string& key) {
    return std::ranges::any_of(warnings(c), [&](const std::string& text) {
      return text.starts_with(key) && text.find("no temperature is computed") != std::string::npos;
    });
  };
  EXPECT_FALSE(is_told(""));
  c.layers = {MaterialLayer{}};
  c.layers[0].inner_radius = 0.3;
  c.layers[0].maximum_temperature = 60;
  EXPECT_TRUE(is_told("material.layer[1].maximum_temperature"));
  c.material.conductivity = 0.3;
  EXPECT_TRUE(is_told("material.conductivity"));
  c.heat.convection = 10;
  EXPECT_FALSE(is_told(""));
}

TEST(CaseReport, TellsThatTheObjectiveIsASumOverTheLoadCases) {
  Case c;
  const auto is_told = [&] {
    return derived_report(c).find("weighted sum over the load cases") != std::string::npos;
  };
  EXPECT_FALSE(is_told());
  c.load.cases = {{.name = "rolling"}, {.name = "kerb"}};
  EXPECT_TRUE(is_told());
  c.objective.minimize = built_in("peak_von_mises");
  EXPECT_TRUE(is_told());
  c.objective.minimize = built_in("volume_fraction");
  EXPECT_FALSE(is_told());
}

TEST(CaseMessages, BothPlacesOfANestedHoleAreReported) {
  const std::string rings =
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.03\n"
      "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = ";
  EXPECT_TRUE(says(rings + "0.03\n", "8:10 0.03 the same hole as that of holes.ring[1] (line 4)"));
  EXPECT_TRUE(says(rings + "0.01\n", "8:10 0.01 the hole lies inside that of holes.ring[1] (line 4)"));
  EXPECT_TRUE(says(rings + "0.035\n", "4:10 0.03 the hole lies inside that of holes.ring[2] (line 8)"));
  EXPECT_TRUE(parse_case(rings + "0.01\nphase = 0\n", "case.toml").value);
}

HoleRing random_ring(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::uniform_int_distribution<int> count(1, 24);
  return {.count = count(random),
          .center_radius = 0.2 + 0.1 * unit(random),
          .radius = 0.005 + 0.06 * unit(random),
          .phase = 20 * unit(random) - 10};
}

struct Relation {
  double minimum = 1e9, most = 0;  ///< azimuth from a hole of one ring to the nearest of the other
  bool inside = false, overlaps = true;
};

/// By all pairs of holes.
Relation relation(const HoleRing& a, const HoleRing& b) {
  const auto centre = [](const HoleRing& r, int i) {
    return std::polar(r.center_radius, *r.phase + 2 * std::numbers::pi * i / r.count);
  };
  Relation result;
  for (int i = 0; i < a.count; ++i) {
    double nearest = 1e9;
    bool overlaps = false;
    for (int j = 0; j < b.count; ++j) {
      const auto p = centre(a, i), q = centre(b, j);
      nearest = std::min(nearest, std::abs(std::arg(p * std::conj(q))));
      result.inside = result.inside || std::abs(p - q) + a.radius <= b.radius;
      overlaps = overlaps || std::abs(p - q) < a.radius + b.radius;
    }
    result.minimum = std::min(result.minimum, nearest);
    result.most = std::max(result.most, nearest);
    result.overlaps = result.overlaps && overlaps;
  }
  return result;
}

TEST(HoleRings, AreComparedAsAllTheirHolesAre) {
  std::mt19937 random(1);
  int inside = 0, overlapping = 0;
  for (int k = 0; k < 4000; ++k) {
    const HoleRing a = random_ring(random), b = random_ring(random);
    const Relation expected = relation(a, b);
    const AzimuthOffsets offsets = azimuth_offsets(a, b);
    EXPECT_NEAR(offsets.minimum, expected.minimum, 1e-12);
    EXPECT_NEAR(offsets.most, expected.most, 1e-12);
    EXPECT_EQ(lies_inside(a, b), expected.inside);
    EXPECT_EQ(overlaps_everywhere(a, b), expected.overlaps);
    inside += expected.inside;
    overlapping += expected.overlaps;
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(overlapping, 100);
}

}  // namespace
}  // namespace wheelwright
