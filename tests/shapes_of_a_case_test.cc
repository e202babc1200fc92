#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/study/loose_material.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"

using namespace wheelwright;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180;

Case case_of(const std::string& text) {
  CaseResult result = parse_case(text, "test.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

/// A wheel without symmetry: one sector.
Case whole_wheel(const std::string& shapes) {
  return case_of("[wheel]\nsectors = 1\n[grid]\nradial_cells = 28\nangular_cells = 240\n" + shapes);
}

bool is_hole(const Case& c, double radius, double azimuth_in_degrees) {
  return Composition(figures(c)).is_hole(polar(radius, azimuth_in_degrees * degree));
}

TEST(Shapes, ARingOfCirclesIsThatOfTheHoles) {
  const Case drawn =
      case_of("[[shape.circle]]\ncount = 32\ncenter_radius = 0.27\nradius = 0.02\nphase = 3\n");
  const Case holes = case_of("[[holes.ring]]\ncount = 32\ncenter_radius = 0.27\nradius = 0.02\nphase = 3\n");
  const auto a = initial_shape<2>(drawn), b = initial_shape<2>(holes);
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-14);
}

TEST(Shapes, AreDrawnOverTheHolesInTheOrderOfTheFile) {
  const std::string disc = "[[shape.circle]]\ncount = 1\ncenter_radius = 0.27\nradius = 0.04\nphase = 40\n",
                    bar =
                        "[[shape.slot]]\nas = \"material\"\ncount = 1\ncenter_radius = 0.27\nlength = 0.1\n"
                        "width = 0.02\nphase = 40\n",
                    ring = "[[holes.ring]]\ncount = 1\ncenter_radius = 0.27\nradius = 0.045\nphase = 40\n",
                    small = "[[shape.circle]]\ncount = 1\ncenter_radius = 0.27\nradius = 0.005\nphase = 40\n";
  EXPECT_TRUE(is_hole(whole_wheel(bar + disc), 0.27, 40));
  EXPECT_FALSE(is_hole(whole_wheel(disc + bar), 0.27, 40));
  EXPECT_FALSE(is_hole(whole_wheel(bar + ring), 0.27, 40));
  const Case interleaved = whole_wheel(disc + bar + small);
  EXPECT_TRUE(is_hole(interleaved, 0.27, 40));
  EXPECT_FALSE(is_hole(interleaved, 0.278, 40));
  const CaseResult again = parse_case(to_toml(interleaved), "test.toml");
  ASSERT_TRUE(again.value);
  EXPECT_EQ(*again.value, interleaved);
}

TEST(Shapes, AreWhereTheirKeysSay) {
  const Case c = whole_wheel(R"([[shape.ellipse]]
count = 1
center_radius = 0.27
length = 0.08
width = 0.03
angle = 30
phase = 20
[[shape.slot]]
count = 1
center_radius = 0.28
length = 0.09
width = 0.02
angle = 80
phase = 100
[[shape.polygon]]
count = 1
points = [[0.23, 0.0], [0.31, 0.02], [0.30, 0.06]]
phase = 200
)");
  const Composition shape(figures(c));
  const auto ends_at = [&](const Point& end, const Point& inwards) {
    EXPECT_NEAR(shape.distance(end, 1), 0, 1e-12);
    EXPECT_TRUE(shape.is_hole(end + 1e-6 * inwards));
    EXPECT_FALSE(shape.is_hole(end - 1e-6 * inwards));
  };
  const Point along_ellipse = polar(1, 50 * degree), along_slot = polar(1, 180 * degree);
  ends_at(polar(0.27, 20 * degree) + 0.04 * along_ellipse, -1 * along_ellipse);
  ends_at(polar(0.27, 20 * degree) - 0.04 * along_ellipse, along_ellipse);
  ends_at(polar(0.28, 100 * degree) + 0.045 * along_slot, -1 * along_slot);
  const Point corner = Affine::rotation(200 * degree)({0.30, 0.06}),
              other = Affine::rotation(200 * degree)({0.23, 0});
  EXPECT_NEAR(shape.distance(corner, 1), 0, 1e-12);
  EXPECT_NEAR(shape.distance(other, 1), 0, 1e-12);
  EXPECT_TRUE(shape.is_hole(Affine::rotation(200 * degree)({0.29, 0.03})));
}

TEST(Shapes, SpokesRunFromTheirFeetToTheirEnds) {
  // The middle of a spoke, and where it has ended sideways.
  const auto expect_spoke = [](const Case& c, double radius, double azimuth, double thickness,
                               double direction) {
    const Composition shape(figures(c));
    const Point middle = polar(radius, azimuth * degree),
                aside = polar(0.5 * thickness, direction * degree + pi / 2);
    for (const double side : {-1.0, 1.0}) {
      EXPECT_FALSE(shape.is_hole(middle + 0.999 * side * aside));
      EXPECT_TRUE(shape.is_hole(middle + 1.001 * side * aside));
    }
  };
  const std::string room = "[[shape.annulus]]\n";
  // Straight: halfway between foot and end.
  const Point foot = polar(0.2, 25 * degree), end = polar(0.34, 45 * degree), half = 0.5 * (foot + end);
  const Point chord = end - foot;
  const double direction = std::atan2(chord[1], chord[0]) / degree;
  expect_spoke(whole_wheel(room + "[[shape.spoke]]\ncount = 1\nthickness = 0.01\nphase = 25\nangle = 20\n"),
               norm<2>(half), std::atan2(half[1], half[0]) / degree, 0.01, direction);
  // Curved: it turns to the left on its way out, so that its middle lies to the right of the chord.
  const double bend = 60 * degree, sagitta = 0.5 * norm<2>(chord) * std::tan(bend / 4);
  const Point right = 1 / norm<2>(chord) * Point{chord[1], -chord[0]}, top = half + sagitta * right;
  expect_spoke(
      whole_wheel(room + "[[shape.spoke]]\nkind = \"curved\"\ncount = 1\nthickness = 0.01\nphase = 25\n"
                         "angle = 20\nbend = 60\n"),
      norm<2>(top), std::atan2(top[1], top[0]) / degree, 0.01, direction);
  // A pair: each half way.
  const Case pair = whole_wheel(room +
                                "[[shape.spoke]]\nkind = \"pair\"\ncount = 1\nthickness = 0.01\nphase = 90\n"
                                "spread = 40\nangle = -10\n");
  for (const double side : {-1.0, 1.0}) {
    const Point a = polar(0.2, (90 + 20 * side) * degree), b = polar(0.34, (90 + 30 * side) * degree),
                m = 0.5 * (a + b);
    const Point along = b - a;
    expect_spoke(pair, norm<2>(m), std::atan2(m[1], m[0]) / degree, 0.01,
                 std::atan2(along[1], along[0]) / degree);
  }
  // A fork: its stem, and its branches.
  const Case fork = whole_wheel(room +
                                "[[shape.spoke]]\nkind = \"forked\"\ncount = 1\nthickness = 0.01\nphase = 0\n"
                                "spread = 20\nfork_radius = 0.25\n");
  expect_spoke(fork, 0.23, 0, 0.01, 0);
  for (const double side : {-1.0, 1.0}) {
    const Point a{0.25, 0}, b = polar(0.34, 10 * side * degree), m = 0.5 * (a + b), along = b - a;
    expect_spoke(fork, norm<2>(m), std::atan2(m[1], m[0]) / degree, 0.01,
                 std::atan2(along[1], along[0]) / degree);
  }
}

TEST(Shapes, SpokesMeetRimAndTreadOnTheirWholeThickness) {
  for (const char* kind :
       {"kind = \"straight\"", "kind = \"curved\"\nbend = 120", "kind = \"curved\"\nbend = -70"}) {
    const Case c = whole_wheel(fmt::format(
        "[[shape.annulus]]\n[[shape.spoke]]\n{}\ncount = 1\nthickness = 0.03\nangle = 25\nphase = 10\n",
        kind));
    const Composition shape(figures(c));
    // No boundary lies beyond the edges of the annulus, and none in the rim or the tread.
    const auto [low, high] = free_region(c);
    for (const Curve& curve : shape.boundary()) {
      EXPECT_GE(norm<2>(curve.at(0.5)), low - 1e-12);
      EXPECT_LE(norm<2>(curve.at(0.5)), high + 1e-12);
    }
  }
}

TEST(Shapes, LooseMaterialIsFoundWithPlaceAndSize) {
  const std::string hole =
      "[wheel]\nsectors = 9\n[grid]\nangular_cells = 378\n[[shape.circle]]\ncount = 9\n"
      "center_radius = 0.265\nradius = 0.04\nphase = 7\n";
  const auto loose = [](const std::string& text) {
    return loose_material(*parse_case(text, "case.toml").value);
  };
  EXPECT_TRUE(loose(hole).empty());
  const auto found = loose(hole +
                           "[[shape.circle]]\nas = \"material\"\ncount = 9\ncenter_radius = 0.27\n"
                           "radius = 0.02\nphase = 9\n");
  ASSERT_EQ(found.size(), 1u);
  const auto expected = [&](const char* before, double value, double tolerance) {
    const auto at = found[0].find(before);
    ASSERT_NE(at, std::string::npos) << found[0];
    EXPECT_NEAR(std::strtod(found[0].c_str() + at + std::strlen(before), nullptr), value, tolerance);
  };
  expected("material of ", std::numbers::pi * 20 * 20, 12);  // [mm^2]
  expected("azimuth ", 9, 0.1);
  expected("radius ", 270, 0.5);
  // Held by a bridge to the edge of the hole it is not loose.
  EXPECT_TRUE(loose(hole + "[[shape.circle]]\nas = \"material\"\ncount = 9\ncenter_radius = 0.287\n"
                           "radius = 0.02\nphase = 9\n")
                  .empty());
}

TEST(Shapes, AWholeWheelIsItsSectorsOnTheSameGrid) {
  const std::string shapes = R"([[shape.annulus]]
[[shape.spoke]]
kind = "curved"
count = 8
thickness = 0.02
angle = 15
bend = 50
phase = 7
[[shape.circle]]
as = "material"
count = 4
center_radius = 0.29
radius = 0.02
)";
  const auto grid = [](int sectors) {
    return fmt::format("[wheel]\nsectors = {}\n[grid]\nradial_cells = 28\nangular_cells = 192\n", sectors);
  };
  const auto sector = initial_shape<2>(case_of(grid(4) + shapes)),
             whole = initial_shape<2>(case_of(grid(1) + shapes));
  ASSERT_EQ(whole.values.size(), 4 * sector.values.size());
  for (std::size_t i = 0; i < whole.values.size(); ++i)
    EXPECT_NEAR(whole.values[i], sector.values[i % sector.values.size()], 1e-13);
}

TEST(Shapes, TheAreaOfSlotsAndEllipsesIsThatOfTheirFormulas) {
  const Case c = case_of(R"([grid]
radial_cells = 56
angular_cells = 768
[[shape.ellipse]]
count = 16
center_radius = 0.26
length = 0.07
width = 0.05
angle = 25
[[shape.slot]]
count = 16
center_radius = 0.26
length = 0.06
width = 0.025
phase = 0
)");
  const auto psi = initial_shape<2>(c);
  const double ring = sector_measure<2>(psi.lattice.grid());
  const double holes = pi / 4 * 0.07 * 0.05 + pi / 4 * 0.025 * 0.025 + 0.035 * 0.025;
  EXPECT_NEAR(material_measure<2>(psi), ring - holes, 2e-6);
}

}  // namespace
