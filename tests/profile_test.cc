// Profiles of bodies of revolution: level sets that are quadratic in the section are exact, and so are the
// volumes of their bodies by Pappus's theorem.

#include "wheelwright/cad/outline/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/cad/outline/check_profile.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
using namespace cad;

namespace {

using std::numbers::pi;

constexpr double tolerance = 1e-5, inner = 0.20, outer = 0.34, width = 0.12;

PolarGrid<3> grid_with(const std::vector<FixedLine>& lines = {}) {
  return {inner, outer, width, 12, {14, 8, 6}, lines};
}

/// The body with psi(axial, radius).
LevelSet<3> turned(const std::function<double(double, double)>& psi, int degree = 2,
                   const std::vector<FixedLine>& lines = {}) {
  LevelSet<3> result{Lattice<3>(grid_with(lines), degree), {}};
  for (int node = 0; node < result.lattice.n_nodes(); ++node) {
    const Vec<3> p = result.lattice.polar_point(node);
    result.values.push_back(psi(p[2], p[0]));
  }
  return result;
}

/// Positive within an ellipse about (axial, radius) with these half axes.
struct Ellipse {
  double axial, radius, a, b;

  double operator()(double z, double r) const {
    const double x = (z - axial) / a, y = (r - radius) / b;
    return 0.5 * std::min(a, b) * (1 - x * x - y * y);
  }
};

/// Of the ring without voids.
const double whole = pi * (outer * outer - inner * inner) * width;

struct Checked {
  Outline profile;
  ProfileReport report;
};

Checked checked(const TurnedSection& section, double within = tolerance) {
  auto profile = fit_profile(section, within);
  EXPECT_TRUE(profile) << profile.failure().what;
  auto report = check_profile(*profile, section, within);
  EXPECT_TRUE(report) << report.failure().front().what;
  return {*profile, *report};
}

TEST(Profile, OfARingIsItsRectangle) {
  const auto [profile, report] = checked(TurnedSection(turned([](double, double) { return -0.1; })));
  EXPECT_EQ(report.curves.lines, 4);
  EXPECT_EQ(report.curves.loops, 1);
  EXPECT_NEAR(report.volume / whole, 1, 1e-14);
  EXPECT_EQ(profile.loops.front().kind, LoopKind::outer_edge);
}

TEST(Profile, SectionHasThePolynomial) {
  const std::vector<FixedLine> lines{{5, 0.237}, {9, 0.281}};
  const auto psi = [](double z, double r) { return 0.3 * z * z * r - z * r * r + 0.2 * r - 0.01; };
  const TurnedSection section(turned(psi, 2, lines));
  for (const Vec<2>& p : {Vec<2>{0.013, 0.222}, Vec<2>{0.071, 0.26}, Vec<2>{0.1199, 0.339}, Vec<2>{0, 0.2}}) {
    const auto [z, r] = p;
    EXPECT_NEAR(section.at(p).psi, psi(z, r), 1e-15);
    EXPECT_NEAR(section.at(p).gradient[0], 0.6 * z * r - r * r, 1e-12);
    EXPECT_NEAR(section.at(p).gradient[1], 0.3 * z * z - 2 * z * r + 0.2, 1e-12);
    const TurnedSection part = section.between(0.21, 0.3395);
    EXPECT_NEAR(part.at(p).psi, psi(z, r), 1e-14);
  }
}

/// A void torus, two grooves of different depth in one side face and in the other, and one in the tread, on
/// rows of unequal height: circles.
TEST(Profile, FindsCirclesAndTheirVolume) {
  struct Example {
    Ellipse disc;
    double volume;  ///< of the void
    int loops;
  };
  const double r = 0.02, chord = 0.008;  // of the last: from its centre to the tread
  const double cap = r * r * std::acos(-chord / r) + chord * std::sqrt(r * r - chord * chord);
  const double first_moment =
      2.0 / 3 * std::pow(r * r - chord * chord, 1.5);  // about its centre, of what is missing
  const Example examples[] = {
      {{0.047, 0.263, r, r}, 2 * pi * 0.263 * pi * r * r, 2},
      {{0, 0.258, r, r}, 2 * pi * 0.258 * pi * r * r / 2, 1},
      {{width, 0.291, r, r}, 2 * pi * 0.291 * pi * r * r / 2, 1},
      {{0.071, outer - chord, r, r}, 2 * pi * ((outer - chord) * cap - first_moment), 1},
  };
  for (const auto& [disc, volume, loops] : examples) {
    const LevelSet<3> psi = turned(disc, 2, {{5, 0.237}, {9, 0.281}});
    const auto [profile, report] = checked(TurnedSection(psi));
    EXPECT_EQ(report.curves.loops, loops);
    EXPECT_EQ(report.cavities, loops - 1);
    EXPECT_EQ(report.curves.arcs, 1);
    EXPECT_EQ(report.curves.splines, 0);
    EXPECT_NEAR((whole - report.volume) / volume, 1, 1e-3 * tolerance / r);
    EXPECT_NEAR(report.volume_error, 0, 1e-5);
    for (const Loop& loop : profile.loops)
      for (const Curve& curve : loop.curves)
        if (const auto* arc = std::get_if<Arc>(&curve)) {
          EXPECT_NEAR(arc->radius, r, 1e-8);
          EXPECT_NEAR(distance(arc->centre, {disc.axial, disc.radius}), 0, 1e-8);
        }
  }
}

TEST(Profile, OfDegreeOneIsACone) {
  const double slope = 0.31;
  const auto cone = [&](double z, double r) { return r - 0.29 - slope * (z - 0.05); };
  const LevelSet<3> psi = turned(cone, 1);
  const auto [profile, report] = checked(TurnedSection(psi));
  EXPECT_EQ(report.curves.lines, 4);
  const double low = 0.29 - slope * 0.05, high = low + slope * width;
  const double volume = pi * width * ((low * low + low * high + high * high) / 3 - inner * inner);
  EXPECT_NEAR(report.volume / volume, 1, 1e-12);
}

/// A groove that has no mirror image, with rounded corners, and one that breaks off a corner.
TEST(Profile, OfAGrooveStaysWithinTheTolerance) {
  const LevelSet<3> psi = with_hole(make_level_set<3>(Lattice<3>(grid_with(), 2), std::span<const Circle>{}),
                                    Groove{0.233, 0.305, 0, 0.071, 0.021});
  for (const double within : {1e-4, 1e-5}) {
    const auto [profile, report] = checked(TurnedSection(psi), within);
    EXPECT_EQ(report.bodies, 1);
    EXPECT_GT(report.curves.splines + report.curves.arcs, 0);
    EXPECT_LE(report.deviation, within);
    EXPECT_NEAR(report.volume / (psi.lattice.grid().n_sectors * material_measure(psi)), 1, 1e-5);
    ASSERT_TRUE(report.wall);
    EXPECT_NEAR(report.wall->width, 0.033, 2e-3);  // below the groove
  }
  const auto corner = [](double z, double r) { return 0.05 - std::hypot(z - width, r - outer); };
  EXPECT_EQ(checked(TurnedSection(turned(corner))).report.curves.loops, 1);
}

TEST(Profile, OfASymmetricBodyIsItsOwnMirrorImage) {
  const Ellipse left{0, 0.26, 0.027, 0.04}, right{width, 0.26, 0.027, 0.04}, low{0.04, 0.31, 0.012, 0.009},
      high{width - 0.04, 0.31, 0.012, 0.009};
  const auto [profile, report] = checked(TurnedSection(turned([&](double z, double r) {
    return std::max({left(z, r), right(z, r), low(z, r), high(z, r)});
  })));
  EXPECT_EQ(report.cavities, 2);
  std::vector<Vec<2>> points;
  for (const Loop& loop : profile.loops)
    for (const Curve& curve : loop.curves)
      if (const auto* spline = std::get_if<Spline>(&curve))
        points.insert(points.end(), spline->points.begin(), spline->points.end());
  EXPECT_GT(points.size(), 20U);
  for (const Vec<2>& p : points) {
    double nearest = INFINITY;
    for (const Vec<2>& q : points) nearest = std::min(nearest, distance(q, {width - p[0], p[1]}));
    EXPECT_LT(nearest, 1e-15);
  }
}

TEST(Profile, PartsBetweenRadiiAddUp) {
  const Ellipse groove{0.01, 0.262, 0.045, 0.037}, torus{0.09, 0.29, 0.017, 0.024};
  const TurnedSection section(
      turned([&](double z, double r) { return std::max(groove(z, r), torus(z, r)); }, 2, {{6, 0.25}}));
  const double sum = checked(section.between(inner, 0.25)).report.volume +
                     checked(section.between(0.25, 0.2834)).report.volume +
                     checked(section.between(0.2834, outer)).report.volume;
  EXPECT_NEAR(sum / checked(section).report.volume, 1, 1e-5);
}

TEST(Profile, VolumeIsTheIntegral) {
  const std::vector<Curve> curves{
      Line{{0.1, 0.2}, {0.3, 0.5}}, Arc{{0.2, 0.1}, 0.3, 1.1, 4.4}, Arc{{-0.2, 0.1}, 0.2, 2.5, -1.7},
      Spline{{0, 0, 0, 0, 0.2, 0.7, 1, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 1}, {2, -1}, {4, 0}, {5, 2}}}};
  for (const Curve& curve : curves) {
    constexpr int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const CurvePoint p = at(curve, (i + 0.5) / n);
      sum -= pi * p.position[1] * p.position[1] * p.velocity[0] / n;
    }
    EXPECT_NEAR(volume_of_revolution({{{LoopKind::hole, {curve}}}}), sum, 1e-6);
    EXPECT_NEAR(volume_of_revolution({{{LoopKind::hole, {mirrored(curve, 0.07)}}}}), -sum, 1e-6);
  }
}

TEST(Profile, FaultsAreFound) {
  const TurnedSection section(turned(Ellipse{0, 0.26, 0.03, 0.04}));
  const Outline profile = checked(section).profile;
  const auto is_valid = [&](const Outline& outline) {
    return static_cast<bool>(check_profile(outline, section, tolerance));
  };
  Outline reversed_loop = profile, open = profile, shifted = profile, crossing = profile, filled = profile;
  std::ranges::reverse(reversed_loop.loops[0].curves);
  for (Curve& curve : reversed_loop.loops[0].curves) curve = reversed(curve);
  open.loops[0].curves.pop_back();
  for (Curve& curve : shifted.loops[0].curves)
    if (auto* spline = std::get_if<Spline>(&curve))
      for (std::size_t i = 1; i + 1 < spline->points.size(); ++i) spline->points[i][0] += 3 * tolerance;
  crossing.loops.push_back({LoopKind::hole, {Arc{{0.06, 0.21}, 0.02, 0, -2 * pi}}});
  std::erase_if(filled.loops[0].curves, [](const Curve& c) { return !std::holds_alternative<Line>(c); });
  EXPECT_TRUE(is_valid(profile));
  for (const Outline* outline : {&reversed_loop, &open, &shifted, &crossing, &filled})
    EXPECT_FALSE(is_valid(*outline)) << outline - &profile;
  EXPECT_FALSE(fit_profile(TurnedSection(turned([](double, double) { return 1.0; })), tolerance));
}

}  // namespace
}  // namespace wheelwright
