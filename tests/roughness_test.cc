#include "wheelwright/cad/outline/roughness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/run/study/roughness_warning.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright::cad {
namespace {

constexpr double pi = std::numbers::pi;

/// Integral over |u| < w of the hat that the curvature is averaged with, times a density of turning.
double mean_of(const std::function<double(double)>& curvature, double s, double w) {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = w * (2 * (i + 0.5) / n - 1);
    sum += (1 - std::abs(u) / w) / w * curvature(s + u) * 2 * w / n;
  }
  return sum;
}

/// Turns of a closed edge of that perimeter and curvature by the definition, by the midpoint rule.
double turns_of(const std::function<double(double)>& curvature, double perimeter, double length) {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double mean = std::abs(mean_of(curvature, (i + 0.5) / n * perimeter, length / 3));
    if (mean > 1 / length) sum += mean * perimeter / n / (2 * pi);
  }
  return sum;
}

/// A hole with `n` equal sides whose corners are rounded with that radius, or sharp.
Loop polygon(int n, double side, double radius, const Vec<2>& centre, double turned) {
  const double angle = 2 * pi / n, straight = side - 2 * radius * std::tan(angle / 2),
               apothem = side / 2 / std::tan(angle / 2);
  Loop loop{LoopKind::hole, {}};
  for (int k = 0; k < n; ++k) {  // clockwise
    const auto at = [&](double along, double across) {
      const Vec<2> p = wheelwright::rotated<2>({across, -along}, turned - k * angle);
      return Vec<2>{centre[0] + p[0], centre[1] + p[1]};
    };
    loop.curves.push_back(Line{at(-straight / 2, apothem), at(straight / 2, apothem)});
    if (radius > 0)
      loop.curves.push_back(Arc{at(straight / 2, apothem - radius), radius, turned - k * angle, -angle});
  }
  return loop;
}

/// A hole with the edge r(phi) about its centre, as `n` cubics that meet with equal tangents.
Loop polar_curve(const std::function<double(double)>& r, int n, const Vec<2>& centre) {
  Loop loop{LoopKind::hole, {}};
  const auto point = [&](double t) {
    const double phi = -2 * pi * t;
    return Vec<2>{centre[0] + r(phi) * std::cos(phi), centre[1] + r(phi) * std::sin(phi)};
  };
  const auto handle = [&](double t, double sign) {
    constexpr double h = 1e-5;
    const Vec<2> a = point(t - h), b = point(t + h), p = point(t);
    const double third = sign / (3.0 * n) / (2 * h);
    return Vec<2>{p[0] + third * (b[0] - a[0]), p[1] + third * (b[1] - a[1])};
  };
  for (int i = 0; i < n; ++i) {
    const double a = static_cast<double>(i) / n, b = static_cast<double>(i + 1) / n;
    loop.curves.push_back(
        Spline{{0, 0, 0, 0, 1, 1, 1, 1}, {point(a), handle(a, 1), handle(b, -1), point(b)}});
  }
  return loop;
}

Loop rotated_loop(const Loop& loop, double angle) {
  Loop result{loop.kind, {}};
  for (const Curve& curve : loop.curves) result.curves.push_back(rotated(curve, angle));
  return result;
}

Loop beginning_with(const Loop& loop, int curve) {
  Loop result = loop;
  std::ranges::rotate(result.curves, result.curves.begin() + curve);
  return result;
}

TEST(Roughness, CircleTurnsOnceBelowLargerLengthsOnly) {
  const Loop circle{LoopKind::hole, {Arc{{0.27, 0.01}, 0.01, 0.3, -2 * pi}}};
  EXPECT_NEAR(edge_roughness(circle, 0.0101).turns, 1, 1e-3);
  EXPECT_EQ(edge_roughness(circle, 0.0099).turns, 0);
  const EdgeRoughness found = edge_roughness(circle, 0.005);
  ASSERT_TRUE(found.internal_corner);
  EXPECT_NEAR(found.internal_corner->radius, 0.01, 1e-5);
  EXPECT_FALSE(found.external_corner);
}

TEST(Roughness, RoundedCornersAreThoseOfTheDefinition) {
  const double side = 0.06, r = 0.004;
  for (const int n : {3, 4, 6}) {
    const Loop loop = polygon(n, side, r, {0.27, 0.02}, 0.4);
    const double arc = r * 2 * pi / n;
    for (const double length : {1.02 * r, 1.5 * r, 3 * r}) {
      // The mean curvature about one corner, whose neighbours are far away.
      const double w = length / 3;
      const auto hat_below = [&](double u) {  // integral of the hat
        u = std::clamp(u / w, -1.0, 1.0);
        return 0.5 + u - 0.5 * u * std::abs(u);
      };
      constexpr int steps = 100000;
      const double step = (arc + 2 * w) / steps;
      double expected = 0;
      for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) * step - w, mean = (hat_below(s) - hat_below(s - arc)) / r;
        if (mean > 1 / length) expected += n * mean * step / (2 * pi);
      }
      EXPECT_NEAR(edge_roughness(loop, length).turns, expected, 3e-3) << n << " " << length;
    }
    EXPECT_EQ(edge_roughness(loop, 0.99 * r).turns, 0);
    EXPECT_NEAR(edge_roughness(loop, r).internal_corner->radius, r, 1e-3 * r);
  }
}

TEST(Roughness, SharpCornersCountWithTheirAngle) {
  // The mean curvature of a corner is alpha (1 - |u| / w) / w: above 1 / length except for the part
  // 1 / (3 alpha) of its height.
  const double length = 0.003;
  for (const int n : {3, 4, 6, 10}) {
    const double alpha = 2 * pi / n;
    const EdgeRoughness found = edge_roughness(polygon(n, 0.02, 0, {0.27, 0}, 0.1), length);
    EXPECT_NEAR(found.turns, 1 - std::pow(1 / (3 * alpha), 2), 2e-3) << n;
    EXPECT_NEAR(found.internal_corner->radius, length / 3 / alpha, 0.05 * length / alpha) << n;
    EXPECT_LT(std::abs(std::hypot(found.sharpest.place[0] - 0.27, found.sharpest.place[1]) -
                       0.01 / std::sin(pi / n)),
              0.1 * length);
  }
}

TEST(Roughness, TipsOfMaterialAreExternalCorners) {
  // A star with five corners in the void and five between them in the material.
  Loop star{LoopKind::hole, {}};
  std::vector<Vec<2>> corners;
  for (int k = 0; k < 10; ++k) {
    const double r = k % 2 == 0 ? 0.03 : 0.018, phi = -k * pi / 5;
    corners.push_back({0.27 + r * std::cos(phi), r * std::sin(phi)});
  }
  for (int k = 0; k < 10; ++k) star.curves.push_back(Line{corners[k], corners[(k + 1) % 10]});
  const auto turn = [&](int k) {
    const Vec<2>&a = corners[(k + 9) % 10], &b = corners[k], &c = corners[(k + 1) % 10];
    const Vec<2> u{b[0] - a[0], b[1] - a[1]}, v{c[0] - b[0], c[1] - b[1]};
    return std::atan2(u[0] * v[1] - u[1] * v[0], dot<2>(u, v));
  };
  ASSERT_LT(turn(0), 0);
  ASSERT_GT(turn(1), 0);
  const double length = 0.002;
  const EdgeRoughness found = edge_roughness(star, length);
  double expected = 0;
  for (const double alpha : {-turn(0), turn(1)}) expected += 5 / (2 * pi) * (alpha - 1 / (9 * alpha));
  EXPECT_NEAR(found.turns, expected, 5e-3);
  ASSERT_TRUE(found.internal_corner && found.external_corner);
  const auto from_centre = [](const Bend& bend) { return std::hypot(bend.place[0] - 0.27, bend.place[1]); };
  EXPECT_NEAR(from_centre(*found.internal_corner), 0.03, 1e-4);
  EXPECT_NEAR(from_centre(*found.external_corner), 0.018, 1e-4);
}

TEST(Roughness, RippledCircleAgreesWithQuadrature) {
  // r = R + a cos(m phi): the curvature in closed form, as a function of arc length by quadrature.
  const double R = 0.03, a = 0.0006;
  const int m = 24;
  const auto r = [&](double phi) { return R + a * std::cos(m * phi); };
  constexpr int n = 20000;
  std::vector<double> arc(n + 1, 0), kappa(n + 1);
  for (int i = 0; i <= n; ++i) {
    const auto speed = [&](double phi) { return std::hypot(r(phi), a * m * std::sin(m * phi)); };
    const double phi = 2 * pi * i / n, r1 = -a * m * std::sin(m * phi), r2 = -a * m * m * std::cos(m * phi);
    kappa[i] = (r(phi) * r(phi) + 2 * r1 * r1 - r(phi) * r2) / std::pow(speed(phi), 3);
    if (i > 0) arc[i] = arc[i - 1] + speed(2 * pi * (i - 0.5) / n) * 2 * pi / n;
  }
  const auto curvature = [&](double s) {
    s -= arc[n] * std::floor(s / arc[n]);
    const auto i = std::min<std::ptrdiff_t>(n, std::ranges::lower_bound(arc, s) - arc.begin());
    return kappa[i];
  };
  const Loop loop = polar_curve(r, 40 * m, {0.27, 0});
  for (const double length : {0.004, 0.006, 0.01}) {
    const double expected = turns_of(curvature, arc[n], length);
    EXPECT_NEAR(edge_roughness(loop, length).turns, expected, 3e-3 * (1 + expected)) << length;
  }
  EXPECT_GT(edge_roughness(loop, 0.006).turns, 2);
}

TEST(Roughness, EllipseIsItsIntegralOfCurvature) {
  // Where the curvature changes little over the mean, these are the angles by which the two parts with a
  // smaller radius than the length turn.
  const double a = 0.06, b = 0.03, length = 0.02;
  const auto r = [&](double phi) { return a * b / std::hypot(b * std::cos(phi), a * std::sin(phi)); };
  // In the parameter t, kappa = a b / (a^2 sin^2 t + b^2 cos^2 t)^(3/2) > 1 / length.
  const double speed2 = std::pow(a * b * length, 2.0 / 3);
  const double t = std::asin(std::sqrt((speed2 - b * b) / (a * a - b * b)));
  const double expected = 4 * std::atan2(a * std::sin(t), b * std::cos(t)) / (2 * pi);
  const EdgeRoughness found = edge_roughness(polar_curve(r, 400, {0.27, 0.1}), length);
  EXPECT_NEAR(found.turns, expected, 0.02);
  EXPECT_NEAR(found.internal_corner->radius, b * b / a, 0.05 * b * b / a);
}

TEST(Roughness, IsTheSameFromAnyStartAndInAnyPosition) {
  const auto r = [](double phi) {
    return 0.02 + 0.001 * std::cos(9 * phi) + 0.0007 * std::sin(14 * phi + 1) + 0.002 * std::cos(2 * phi);
  };
  const Loop loop = polar_curve(r, 300, {0.25, 0.05});
  const double length = 0.004, turns = edge_roughness(loop, length).turns;
  EXPECT_GT(turns, 0.5);
  for (const int curve : {17, 120, 283})
    EXPECT_NEAR(edge_roughness(beginning_with(loop, curve), length).turns, turns, 1e-3);
  for (const double angle : {0.3, 1.1, 4.0}) {
    const EdgeRoughness found = edge_roughness(rotated_loop(loop, angle), length);
    EXPECT_NEAR(found.turns, turns, 1e-9);
    const Vec<2> back = wheelwright::rotated<2>(found.sharpest.place, -angle);
    EXPECT_NEAR(std::hypot(back[0] - edge_roughness(loop, length).sharpest.place[0],
                           back[1] - edge_roughness(loop, length).sharpest.place[1]),
                0, 1e-9);
  }
  // Divided differently: other knots, other samples.
  EXPECT_NEAR(edge_roughness(polar_curve(r, 471, {0.25, 0.05}), length).turns, turns, 1e-3);
}

TEST(Roughness, OfAnOutlineIsThatOfItsRoughestEdge) {
  // Without symmetry; then the same holes in every third of the ring, where one of three is measured.
  const Loop round{LoopKind::hole, {Arc{{0.27, 0}, 0.02, 0, -2 * pi}}};
  const Loop square = polygon(4, 0.03, 0, cartesian<2>({0.27, 1.3}), 0.2);
  const double length = 0.004, turns = edge_roughness(square, length).turns;
  const Loop outer{LoopKind::outer_edge, {Arc{{0, 0}, 0.34, 0, 2 * pi}}},
      bore{LoopKind::bore, {Arc{{0, 0}, 0.2, 0, -2 * pi}}};
  Outline outline{{outer, bore}};
  EXPECT_FALSE(roughness(outline, 1, length));
  outline.loops.push_back(round);
  EXPECT_EQ(roughness(outline, 1, length)->edge.turns, 0);
  outline.loops.push_back(square);
  EXPECT_NEAR(roughness(outline, 1, length)->edge.turns, turns, 1e-9);
  EXPECT_NEAR(roughness(outline, 1, length)->internal_corner->radius,
              edge_roughness(square, length).internal_corner->radius, 1e-9);
  Outline repeated{{outer, bore}};
  for (int sector = 0; sector < 3; ++sector)
    for (const Loop& loop : {round, square})
      repeated.loops.push_back(rotated_loop(loop, sector * 2 * pi / 3));
  EXPECT_NEAR(roughness(repeated, 3, length)->edge.turns, turns, 1e-9);
  // Holes that are no images of each other are all measured, however many sectors there are.
  Outline few{{outer, bore, round, rotated_loop(square, 0.1)}};
  EXPECT_NEAR(roughness(few, 5, length)->edge.turns, turns, 1e-9);
}

Roughness with_turns(double turns) {
  return {0.005, {turns, {0.001, cartesian<2>({0.27, 0.5})}, {}, {}}, {}, {}};
}

/// A level set of the whole ring whose hole is r(phi) about a centre at azimuth `turned`, of this degree.
LevelSet<2> hole(const std::function<double(double)>& r, int degree, double turned) {
  const PolarGrid<2> grid{0.2, 0.34, 0.12, 1, {28, 384}};
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const Vec<2> p = wheelwright::rotated<2>(cartesian<2>(psi.lattice.polar_point(node)), -turned);
    psi.values.push_back(r(std::atan2(p[1], p[0] - 0.27)) - std::hypot(p[0] - 0.27, p[1]));
  }
  return psi;
}

TEST(Roughness, OfALevelSetIsThatOfItsEdgeWhereverItLiesOnTheGrid) {
  const auto r = [](double phi) { return 0.03 + 0.002 * std::cos(12 * phi) + 0.001 * std::sin(5 * phi); };
  const double cell = hole(r, 2, 0).lattice.grid().resolution();
  const EdgeRoughness exact = edge_roughness(polar_curve(r, 400, {0.27, 0}), cell);
  EXPECT_GT(exact.turns, 0.5);
  for (const double turned : {0.0, 0.7301, 4.1}) {
    const auto found = outline_measures(hole(r, 2, turned))->roughness;
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length, cell);
    EXPECT_NEAR(found->edge.turns, exact.turns, 0.1 * exact.turns) << turned;
    EXPECT_NEAR(found->internal_corner->radius, exact.internal_corner->radius,
                0.15 * exact.internal_corner->radius);
    const Vec<2> centre = wheelwright::rotated<2>({0.27, 0}, turned);
    EXPECT_LT(
        std::hypot(found->edge.sharpest.place[0] - centre[0], found->edge.sharpest.place[1] - centre[1]),
        0.034);
  }
  // In 3D edges are no plane curves.
  const PolarGrid<3> solid{0.2, 0.34, 0.12, 16, {7, 6, 2}};
  const Lattice<3> lattice(solid, 1);
  EXPECT_FALSE(outline_measures(LevelSet<3>{lattice, std::vector<double>(lattice.n_nodes(), -1)})->roughness);
}

TEST(RoughnessWarning, ConcernsOnlyNewRoughness) {
  const Case drawn;
  EXPECT_EQ(roughness_warning(drawn, {}, {}), "");
  EXPECT_EQ(roughness_warning(drawn, with_turns(0.89), with_turns(0)), "");
  EXPECT_NE(roughness_warning(drawn, with_turns(0.91), with_turns(0)), "");
  EXPECT_NE(roughness_warning(drawn, with_turns(0.91), {}), "");
  EXPECT_NE(roughness_warning(drawn, with_turns(2.0), with_turns(0.8)), "");
  EXPECT_EQ(roughness_warning(drawn, with_turns(2.0), with_turns(1.95)), "");
  EXPECT_NE(roughness_warning(drawn, with_turns(2.0), with_turns(1.85)), "");
  Case continued;
  continued.saved_shape.from = "runs/a";
  EXPECT_NE(roughness_warning(continued, with_turns(2.0), with_turns(1.95)), "");
  EXPECT_EQ(roughness_warning(continued, with_turns(0.89), with_turns(1.95)), "");
}

TEST(RoughnessWarning, NamesThePlaceAndAnUnusedRemedy) {
  Case c;
  const std::string quadratic = roughness_warning(c, with_turns(2), {});
  EXPECT_NE(quadratic.find(place_of(with_turns(2).edge.sharpest.place)), std::string::npos);
  EXPECT_NE(quadratic.find("level_set_degree = 1"), std::string::npos);
  c.grid.level_set_degree = 1;
  EXPECT_EQ(roughness_warning(c, with_turns(2), {}).find("level_set_degree"), std::string::npos);
}

}  // namespace
}  // namespace wheelwright::cad
