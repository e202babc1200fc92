#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "wheelwright/cad/drawing/chain.h"
#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;
using std::numbers::pi;

namespace {

class Random {
 public:
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  Point point(double size) { return {number(-size, size), number(-size, size)}; }
  Curve curve() {
    switch (engine_() % 4) {
      case 0:
        return Curve::line(point(1), point(1));
      case 1:
        return Curve::circle_arc(point(1), number(0.01, 1), number(-7, 7), number(-7, 7));
      case 2:
        return Curve::arc(point(1), point(1), point(1), number(-7, 7), number(-7, 7));
      default:
        return Curve::cubic(point(1), point(1), point(1), point(1));
    }
  }

 private:
  std::mt19937 engine_{1};
};

/// Nearest of many points on the curve: too large by at most the square of their spacing.
double sampled_distance(const Curve& curve, const Point& x) {
  double nearest = INFINITY;
  constexpr int n = 4000;
  for (int i = 0; i <= n; ++i) nearest = std::min(nearest, distance(curve.at(double(i) / n), x));
  return nearest;
}

double exact_distance(const Curve& curve, const Point& x) {
  double nearest = INFINITY;
  for (const Curve& piece : simple_pieces(curve))
    nearest = std::min(nearest, std::sqrt(piece.nearest(x).distance2));
  return nearest;
}

TEST(Curve, DerivativesAreThoseOfFiniteDifferences) {
  Random random;
  for (int k = 0; k < 100; ++k) {
    const Curve curve = random.curve();
    const double s = random.number(0.1, 0.9), h = 1e-5;
    const Point slope = 1 / (2 * h) * (curve.at(s + h) - curve.at(s - h));
    const Point bend = 1 / (2 * h) * (curve.derivative(s + h) - curve.derivative(s - h));
    EXPECT_NEAR(distance(slope, curve.derivative(s)), 0, 1e-6);
    EXPECT_NEAR(distance(bend, curve.second_derivative(s)), 0, 1e-5);
  }
}

TEST(Curve, PiecesAndReversedAndMappedCurvesAreThoseOfTheWhole) {
  Random random;
  for (int k = 0; k < 100; ++k) {
    const Curve curve = random.curve();
    const double from = random.number(0, 0.5), to = random.number(0.5, 1), s = random.number(0, 1);
    const Affine map{random.number(-1, 1), random.number(-1, 1), random.number(-1, 1),
                     random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
    EXPECT_NEAR(distance(curve.part(from, to).at(s), curve.at(from + s * (to - from))), 0, 1e-13);
    EXPECT_NEAR(distance(curve.reversed().at(s), curve.at(1 - s)), 0, 1e-13);
    EXPECT_NEAR(distance(curve.mapped(map).at(s), map(curve.at(s))), 0, 1e-13);
    EXPECT_EQ(distance(curve.split(from).first.end(), curve.split(from).second.start()), 0);
  }
}

TEST(Curve, BoxContainsTheCurve) {
  Random random;
  for (int k = 0; k < 200; ++k) {
    const Curve curve = random.curve();
    const Box box = curve.box();
    for (int i = 0; i <= 100; ++i) EXPECT_LE(box.distance2(curve.at(i / 100.0)), 1e-28);
  }
  const Box box = Curve::circle_arc({1, 2}, 3, 0.1, 3).box();
  EXPECT_NEAR(box.high[1], 5, 1e-14);
  EXPECT_NEAR(box.low[0], 1 + 3 * std::cos(3), 1e-14);
}

TEST(Curve, TheDistanceIsThatToTheNearestOfItsPoints) {
  Random random;
  for (int k = 0; k < 400; ++k) {
    const Curve curve = random.curve();
    const Point x = random.point(1.5);
    const double exact = exact_distance(curve, x), sampled = sampled_distance(curve, x);
    double length = 0;
    for (int i = 0; i < 100; ++i) length += distance(curve.at(i / 100.0), curve.at((i + 1) / 100.0));
    EXPECT_LE(exact, sampled + 1e-12);
    // Between two samples the distance falls by at most half their spacing.
    EXPECT_GE(exact, sampled - 2 * length / 4000) << k;
  }
}

TEST(Curve, TheDistanceFromAnEllipseIsThatOfItsNormal) {
  // A point on the normal, nearer than the radius of curvature, has its foot where the normal begins.
  Random random;
  for (int k = 0; k < 200; ++k) {
    const double a = random.number(0.1, 1), b = random.number(0.1, 1), t = random.number(0, 2 * pi);
    const Point foot{a * std::cos(t), b * std::sin(t)};
    const Point normal =
        1 / std::hypot(b * std::cos(t), a * std::sin(t)) * Point{b * std::cos(t), a * std::sin(t)};
    const double min_radius = std::min(a * a / b, b * b / a), away = random.number(-0.9, 3) * min_radius;
    const Curve ellipse = Curve::arc({}, {a, 0}, {0, b}, 0, 2 * pi);
    EXPECT_NEAR(exact_distance(ellipse, foot + away * normal), std::abs(away), 1e-13);
  }
}

TEST(Curve, MeetingsLieOnBothCurvesAndAllAreFound) {
  Random random;
  int total = 0;
  for (int k = 0; k < 300; ++k) {
    const Curve a = random.curve(), b = random.curve();
    for (const Curve& p : simple_pieces(a))
      for (const Curve& q : simple_pieces(b)) {
        const auto found = meetings(p, q);
        for (const auto& [s, t] : found) EXPECT_NEAR(distance(p.at(s), q.at(t)), 0, 1e-8);
        // Polylines through points of the pieces cross as often.
        int crossed = 0;
        constexpr int n = 40;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            const Point p0 = p.at(double(i) / n), p1 = p.at((i + 1.0) / n), q0 = q.at(double(j) / n),
                        q1 = q.at((j + 1.0) / n);
            crossed += cross(p1 - p0, q0 - p0) * cross(p1 - p0, q1 - p0) < 0 &&
                       cross(q1 - q0, p0 - q0) * cross(q1 - q0, p1 - q0) < 0;
          }
        EXPECT_EQ(static_cast<int>(found.size()), crossed) << k;
        total += crossed;
      }
  }
  EXPECT_GT(total, 100);
}

TEST(Curve, ARayCrossesItAsOftenAsManyShortLines) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    const Curve curve = random.curve();
    const Point x = random.point(1);
    int crossed = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i)
      crossed += ray_crossings(Curve::line(curve.at(double(i) / n), curve.at((i + 1.0) / n)), x);
    if (exact_distance(curve, x) > 1e-3) {
      EXPECT_EQ(ray_crossings(curve, x), crossed) << k;
    }
  }
}

TEST(Outline, CrossingsAreFoundWithTheirPlace) {
  const DrawnOutline bow = polygon_outline({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  const auto found = crossings(bow, 5);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(distance(found[0].at, {1, 1}), 0, 1e-12);
  EXPECT_TRUE(crossings(polygon_outline({{0, 0}, {2, 0}, {2, 2}, {0, 2}}), 5).empty());
  EXPECT_TRUE(crossings(annulus_outline(1, 2), 5).empty());
  DrawnOutline twice = circle_outline({}, 1);
  twice.loops.push_back(twice.loops[0]);
  EXPECT_FALSE(crossings(twice, 5).empty());
  DrawnOutline overlapping = circle_outline({}, 1);
  overlapping.loops.push_back(circle_outline(Affine::shift({1, 0}), 1).loops[0]);
  EXPECT_EQ(crossings(overlapping, 5).size(), 2u);
}

TEST(Outline, ExtentsOfAShiftedCircleAreItsNearestAndFarthestPoints) {
  RadialExtent all{INFINITY, 0, {}, {}};
  const DrawnOutline circle = circle_outline(polar_frame(0.27, 0.3, 0.2), 0.05);
  for (const Curve& curve : circle.loops[0].curves) {
    const RadialExtent extent = radial_extent(curve);
    all.low = std::min(all.low, extent.low);
    all.high = std::max(all.high, extent.high);
  }
  EXPECT_NEAR(all.low, 0.22, 1e-14);
  EXPECT_NEAR(all.high, 0.32, 1e-14);
}

TEST(Chain, CurvesInAnyOrderAndDirectionFormTheirLoops) {
  const Curve top = Curve::circle_arc({0, 0}, 1, 0, pi), bottom = Curve::line({1, 0}, {-1, 0});
  const Curve small = Curve::circle_arc({0, 5}, 1, 0, 2 * pi);
  const Chains chains = chained({{bottom, "b"}, {small, "s"}, {top, "t"}}, 1e-9);
  EXPECT_TRUE(chains.open_ends.empty());
  ASSERT_EQ(chains.loops.size(), 2u);
  for (const DrawnLoop& loop : chains.loops)
    for (std::size_t i = 0; i < loop.curves.size(); ++i)
      EXPECT_EQ(loop.curves[i].end(), loop.curves[(i + 1) % loop.curves.size()].start());
}

TEST(Chain, OpenEndsAndBranchesAreReportedWhereTheyAre) {
  const auto open = chained({{Curve::line({0, 0}, {1, 0}), "a"}, {Curve::line({1, 0}, {1, 1}), "b"}}, 1e-9);
  ASSERT_EQ(open.open_ends.size(), 1u);
  EXPECT_EQ(open.open_ends[0].at, (Point{1, 1}));
  EXPECT_FALSE(open.open_ends[0].branches);
  const auto branched = chained({{Curve::line({0, 0}, {1, 0}), "a"},
                                 {Curve::line({1, 0}, {1, 1}), "b"},
                                 {Curve::line({1, 0}, {2, 1}), "c"}},
                                1e-9);
  EXPECT_TRUE(branched.open_ends[0].branches);
}

/// A slot given by its signed distance: of a line, minus the radius.
double slot_depth(const Point& x, const Affine& frame, double length, double width) {
  const double half = 0.5 * (length - width);
  const Curve middle = Curve::line(frame({-half, 0}), frame({half, 0}));
  return 0.5 * width - std::sqrt(middle.nearest(x).distance2);
}

TEST(Parts, SignedDistancesAreThoseOfTheirFormulas) {
  Random random;
  const Affine frame = polar_frame(0.27, 0.3, 0.7);
  const Composition slot({{Fill::hole, {slot_outline(frame, 0.1, 0.03)}}});
  const Composition circle({{Fill::hole, {circle_outline(frame, 0.04)}}});
  // A strip about an arc of radius 0.1 that turns to the left by 1 rad, from (0, 0).
  const double bend = 1, r = 0.1, half = 0.01;
  const Point centre{0, r}, end{r * std::sin(bend), r - r * std::cos(bend)};
  const Composition strip({{Fill::hole, {strip_outline({0, 0}, end, 2 * half, bend)}}});
  const auto signed_distance = [](const Composition& shape, const Point& x) {
    const double d = shape.distance(x, 10);
    return shape.is_hole(x) ? d : -d;
  };
  for (int k = 0; k < 1000; ++k) {
    const Point x = random.point(0.4);
    EXPECT_NEAR(signed_distance(slot, x), slot_depth(x, frame, 0.1, 0.03), 1e-14);
    EXPECT_NEAR(signed_distance(circle, x), 0.04 - distance(x, polar(0.27, 0.3)), 1e-14);
    // Beside the middle of the strip its long edges are nearest.
    const double turned = random.number(0.2, 0.8), radius = random.number(0.085, 0.115);
    const Point beside = centre + radius * Point{std::sin(turned), -std::cos(turned)};
    EXPECT_NEAR(signed_distance(strip, beside), half - std::abs(radius - r), 1e-14);
  }
}

const PolarGrid<2> grid{0.20, 0.34, 0.12, 4, {28, 96}};

TEST(Composition, IsTheLevelSetOfTheHolesOnTheirOwn) {
  // Apart from each other, where both are exact.
  const std::vector<Circle> holes{{0.27, 0.3, 0.03}, {0.3, 1.1, 0.02}};
  Figure figure{Fill::hole, {}};
  for (const Circle& hole : holes)
    for (int i = 0; i < grid.n_sectors; ++i)
      figure.outlines.push_back(
          circle_outline(polar_frame(hole.centre_radius, hole.centre_azimuth + i * grid.sector_angle(), 0),
                         hole.hole_radius));
  const Lattice<2> lattice(grid, 2);
  const auto drawn = make_level_set(lattice, Composition({figure})),
             known = make_level_set<2>(lattice, holes);
  for (int i = 0; i < lattice.n_nodes(); ++i) EXPECT_NEAR(drawn.values[i], known.values[i], 1e-14);
}

TEST(Composition, LaterFiguresCoverEarlierOnes) {
  const DrawnOutline disc = circle_outline(Affine::shift({0.27, 0}), 0.05);
  const DrawnOutline bar = strip_outline({0.2, 0}, {0.34, 0}, 0.02, 0);
  const Composition cut({{Fill::hole, {disc}}, {Fill::material, {bar}}}),
      whole({{Fill::material, {bar}}, {Fill::hole, {disc}}});
  EXPECT_FALSE(cut.is_hole({0.27, 0.005}));
  EXPECT_TRUE(cut.is_hole({0.27, 0.015}));
  EXPECT_TRUE(whole.is_hole({0.27, 0.005}));
  // The distance to what is covered does not count: at the disc's edge under the bar it is that to the
  // corner.
  const double corner = 0.27 + std::sqrt(0.05 * 0.05 - 0.01 * 0.01);
  EXPECT_NEAR(cut.distance({0.319, 0}, 1), std::hypot(0.319 - corner, 0.01), 1e-12);
  EXPECT_NEAR(whole.distance({0.319, 0}, 1), 0.001, 1e-14);
  // Where the bar lies in the disc its own edge is the boundary.
  EXPECT_NEAR(cut.distance({0.27, 0.003}, 1), 0.007, 1e-14);
}

TEST(Composition, HolesThatShareAnEdgeAreOne) {
  const DrawnOutline left = polygon_outline({{0, 0}, {1, 0}, {1, 1}, {0, 1}}),
                     right = polygon_outline({{1, 0}, {2, 0}, {2, 0.5}, {1, 0.5}});
  const Composition joined({{Fill::hole, {left, right}}});
  EXPECT_TRUE(joined.is_hole({1, 0.25}));
  EXPECT_NEAR(joined.distance({1, 0.25}, 10), 0.25, 1e-12);
  EXPECT_NEAR(joined.distance({1, 0.75}, 10), 0, 1e-12);
}

TEST(Composition, MaterialOverTheSameHoleLeavesNoEdge) {
  const DrawnOutline disc = circle_outline(Affine::shift({0.27, 0}), 0.05);
  EXPECT_TRUE(Composition({{Fill::hole, {disc}}, {Fill::material, {disc}}}).boundary().empty());
}

// Where rounding is as large as the curves, dividing them must end all the same.
TEST(Composition, OutlinesAsSmallAsRoundingAreComposedToo) {
  for (const double radius : {1e-9, 1e-13, 1e-17}) {
    const Point from{0.3, 0.3}, to{-0.3, -0.3};
    const Composition line(
        {{Fill::hole,
          {circle_outline(Affine::shift(from), radius), strip_outline(from, to, 2 * radius, 0),
           circle_outline(Affine::shift(to), radius)}}});
    EXPECT_FALSE(line.is_hole({0.3, -0.3}));
  }
}

TEST(Composition, IsTheExactDistanceOfRandomUnionsAndDifferences) {
  Random random;
  for (int k = 0; k < 10; ++k) {
    std::vector<Figure> figures;
    for (int i = 0; i < 6; ++i) {
      const Affine frame = polar_frame(random.number(0, 0.3), random.number(0, 7), random.number(0, 7));
      const DrawnOutline outline =
          i % 3 == 0   ? ellipse_outline(frame, random.number(0.1, 0.4), random.number(0.1, 0.4))
          : i % 3 == 1 ? slot_outline(frame, 0.3, random.number(0.02, 0.2))
                       : polygon_outline({frame({0, 0}), frame({0.3, 0}), frame({0.1, 0.2})});
      figures.push_back({i % 2 == 0 ? Fill::hole : Fill::material, {outline}});
    }
    const Composition shape(figures);
    // Walk from a point to the boundary: the sign changes nowhere nearer than the distance.
    for (int n = 0; n < 200; ++n) {
      const Point x = random.point(0.4);
      const double d = shape.distance(x, 10);
      for (int i = 0; i < 60; ++i)
        EXPECT_EQ(shape.is_hole(x + 0.999999 * d * polar(random.number(0, 1), 2 * pi * i / 60)),
                  shape.is_hole(x));
    }
    // On both sides of the boundary the shape differs.
    for (const Curve& curve : shape.boundary()) {
      const Point along = curve.derivative(0.5);
      const Point aside = 1e-6 / norm<2>(along) * Point{-along[1], along[0]};
      if (norm<2>(along) < 1e-3) continue;
      EXPECT_NE(shape.is_hole(curve.at(0.5) + aside), shape.is_hole(curve.at(0.5) - aside));
    }
  }
}

}  // namespace
