#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support.h"
#include "wheelwright/cad/outline/check_outline.h"
#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/cad/outline/cut_outline.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/cad/outline/spline_fit.h"
#include "wheelwright/cad/outline/triangulation.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/zero_contour.h"

namespace wheelwright {
using namespace cad;

namespace {

using std::numbers::pi;
using testing::Hole;
using testing::holes;

constexpr double tolerance = 1e-5;

PolarGrid<2> wheel(int sectors, int radial = 28, int ring_columns = 384) {
  return {0.20, 0.34, 0.12, sectors, {radial, ring_columns / sectors}};
}

/// Seven sectors with three different holes each, one of them across the sector's border.
const std::vector<Hole> different_holes{
    {0.266, 0.035, 0.024}, {0.2823, 0.3812, 0.028}, {0.249, 0.698, 0.019}};

/// A hole whose edge r(azimuth) has no symmetry, repeated in every sector.
LevelSet<2> crooked_hole(const PolarGrid<2>& grid, int degree) {
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  const double middle = 0.37 * grid.sector_angle();
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> polar = psi.lattice.polar_point(i);
    const double azimuth = std::remainder(polar[1] - middle, grid.sector_angle());
    const double x = polar[0] - 0.268, y = 0.268 * azimuth, r = std::hypot(x, y), t = std::atan2(y, x);
    psi.values.push_back(0.03 * (1 + 0.15 * std::cos(3 * t + 0.4) + 0.05 * std::sin(5 * t)) - r);
  }
  return psi;
}

Outline outline_of(const LevelSet<2>& psi, double within = tolerance) {
  auto outline = fit_outline(psi, within);
  EXPECT_TRUE(outline) << outline.failure().what;
  return *outline;
}

Arc circle(double x, double y, double radius, double sweep) { return {{x, y}, radius, 0, sweep}; }

std::vector<Curve> sample_curves() {
  return {Line{{0.1, -0.2}, {0.3, 0.5}}, Arc{{0.2, 0.1}, 0.3, 1.1, 4.4}, Arc{{-0.2, 0.1}, 0.2, 2.5, -1.7},
          Spline{{0, 0, 0, 0, 0.2, 0.7, 1, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 1}, {2, -1}, {4, 0}, {5, 2}}}};
}

// --- Curves ---------------------------------------------------------------------------------------------

TEST(Curves, AreaUnderACurveIsTheIntegral) {
  for (const Curve& curve : sample_curves()) {
    constexpr int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const CurvePoint p = at(curve, (i + 0.5) / n);
      sum += 0.5 * (p.position[0] * p.velocity[1] - p.position[1] * p.velocity[0]) / n;
    }
    EXPECT_NEAR(area_under(curve), sum, 1e-7);
  }
}

TEST(Curves, VelocityIsTheDerivativeOfThePosition) {
  constexpr double h = 1e-6;
  for (const Curve& curve : sample_curves())
    for (const double t : {0.05, 0.31, 0.66, 0.95})
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(at(curve, t).velocity[d],
                    (at(curve, t + h).position[d] - at(curve, t - h).position[d]) / (2 * h), 1e-7);
}

TEST(Curves, ReversedRunsBackAndRotatedIsTurned) {
  constexpr double angle = 0.7;
  for (const Curve& curve : sample_curves()) {
    EXPECT_NEAR(area_under(reversed(curve)), -area_under(curve), 1e-14);
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      EXPECT_LT(distance(at(reversed(curve), 1 - t).position, at(curve, t).position), 1e-14);
      EXPECT_LT(distance(at(rotated(curve, angle), t).position, rotated<2>(at(curve, t).position, angle)),
                1e-14);
    }
  }
}

TEST(Curves, BeziersAndChordsKeepTheirTolerance) {
  for (const double within : {1e-2, 1e-4, 1e-6}) {
    for (const Curve& curve : sample_curves()) {
      const auto* arc = std::get_if<Arc>(&curve);
      double area = 0;
      for (const Bezier& p : beziers(curve, within)) {
        const Curve piece = Spline{{0, 0, 0, 0, 1, 1, 1, 1}, {p.begin(), p.end()}};
        area += area_under(piece);
        for (int i = 0; arc && i <= 20; ++i)
          EXPECT_NEAR(distance(at(piece, i / 20.0).position, arc->centre), arc->radius, within);
      }
      EXPECT_NEAR(area, area_under(curve), arc ? 2 * within : 1e-14);
      auto points = flattened(curve, within);
      points.push_back(end_of(curve));
      EXPECT_EQ(points.front(), start_of(curve));
      for (int i = 0; i <= 1000; ++i) {
        const Vec<2> p = at(curve, i / 1000.0).position;
        double nearest = INFINITY;
        for (std::size_t k = 1; k < points.size(); ++k) {
          const Vec<2>&a = points[k - 1], &b = points[k], side{b[0] - a[0], b[1] - a[1]},
                from{p[0] - a[0], p[1] - a[1]};
          const double t = std::clamp(dot<2>(from, side) / dot<2>(side, side), 0.0, 1.0);
          nearest = std::min(nearest, std::hypot(from[0] - t * side[0], from[1] - t * side[1]));
        }
        EXPECT_LE(nearest, within * (1 + 1e-9));
      }
    }
  }
}

TEST(Curves, DividedCubicsAreTheSameCurve) {
  const Bezier cubic{{{0, 0}, {1, 2}, {3, -1}, {4, 1}}};
  const auto parts = divided(cubic, 3);
  ASSERT_EQ(parts.size(), 3U);
  const auto curve = [](const Bezier& p) {
    return Curve(Spline{{0, 0, 0, 0, 1, 1, 1, 1}, {p.begin(), p.end()}});
  };
  for (int i = 0; i < 3; ++i)
    for (const double t : {0.0, 0.3, 1.0})
      EXPECT_LT(distance(at(curve(parts[i]), t).position, at(curve(cubic), (i + t) / 3).position), 1e-14);
}

// --- Splines --------------------------------------------------------------------------------------------

std::vector<Vec<2>> ellipse(int n, double a, double b) {
  std::vector<Vec<2>> points;
  for (int i = 0; i < n; ++i) points.push_back({a * std::cos(2 * pi * i / n), b * std::sin(2 * pi * i / n)});
  return points;
}

TEST(SplineFit, ClosedSplineFollowsAnEllipseWithinTheTolerance) {
  for (const double within : {1e-4, 1e-5, 1e-6, 1e-7}) {
    const auto spline = fit_spline(ellipse(4001, 0.05, 0.03), true, within);
    ASSERT_TRUE(spline);
    for (int i = 0; i <= 3000; ++i) {
      const Vec<2> p = at(*spline, i / 3000.0).position;
      // To first order, the distance from the ellipse.
      const double f = std::hypot(p[0] / 0.05, p[1] / 0.03) - 1;
      EXPECT_LE(std::abs(f) * 0.03, 1.1 * within);
    }
    EXPECT_NEAR(area_under(*spline), pi * 0.05 * 0.03, 2 * pi * 0.05 * within);
  }
}

TEST(SplineFit, NumberOfCubicsGrowsWithTheFourthRootOfTheTolerance) {
  const auto n_points = [](double within) {
    const auto spline = fit_spline(ellipse(8001, 0.05, 0.03), true, within);
    return spline ? static_cast<double>(spline->points.size()) - 3 : NAN;
  };
  const double order = std::log(n_points(1e-9) / n_points(1e-5)) / std::log(1e4);
  EXPECT_NEAR(order, 0.25, 0.05);
}

/// Largest jump of the first and of the second derivative with respect to the parameter at the knots.
Vec<2> jumps(const Spline& spline, bool closed) {
  Vec<2> jump{};
  const auto pieces = beziers(spline, 1);
  const int n = static_cast<int>(pieces.size());
  const auto length = [&](int i) { return spline.knots[i + 4] - spline.knots[i + 3]; };
  for (int i = closed ? 0 : 1; i < n; ++i) {
    const int b = (i + n - 1) % n;
    const Bezier &p = pieces[b], &q = pieces[i];
    const double lp = length(b), lq = length(i);
    for (int d = 0; d < 2; ++d) {
      jump[0] = std::max(jump[0], std::abs((p[3][d] - p[2][d]) / lp - (q[1][d] - q[0][d]) / lq));
      jump[1] = std::max(jump[1], std::abs((p[3][d] - 2 * p[2][d] + p[1][d]) / (lp * lp) -
                                           (q[2][d] - 2 * q[1][d] + q[0][d]) / (lq * lq)));
    }
  }
  return jump;
}

TEST(SplineFit, CurvatureIsContinuousAlsoWhereTheSplineCloses) {
  const auto closed = fit_spline(ellipse(4000, 0.05, 0.03), true, 1e-6);
  ASSERT_TRUE(closed);
  EXPECT_LT(jumps(*closed, true)[0], 1e-11);
  EXPECT_LT(jumps(*closed, true)[1], 1e-9);
  auto points = ellipse(4000, 0.05, 0.03);
  points.resize(2500);
  const auto open = fit_spline(points, false, 1e-6);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->points.front(), points.front());
  EXPECT_EQ(open->points.back(), points.back());
  EXPECT_LT(jumps(*open, false)[0], 1e-11);
  EXPECT_LT(jumps(*open, false)[1], 1e-9);
}

TEST(SplineFit, CornerIsNotFittedAndItsPlaceIsReported) {
  std::vector<Vec<2>> points;
  for (int i = 0; i <= 200; ++i)
    points.push_back(i <= 80 ? Vec<2>{1e-4 * i, 0} : Vec<2>{8e-3, 1e-4 * (i - 80)});
  const auto spline = fit_spline(points, false, 1e-6);
  ASSERT_FALSE(spline);
  EXPECT_LT(distance(spline.failure().place, {8e-3, 0}), 5e-4);
}

// --- Outlines -------------------------------------------------------------------------------------------

TEST(ZeroContour, ValueAndGradientAreThoseOfALinearFunction) {
  for (const int degree : {1, 2}) {
    LevelSet<2> psi{Lattice<2>(wheel(1, 7, 60), degree), {}};
    for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
      const Vec<2> x = cartesian<2>(psi.lattice.polar_point(i));
      psi.values.push_back(0.3 * x[0] - 0.8 * x[1] + 0.05);
    }
    const ZeroContour zero(psi);
    std::mt19937 random(1);
    for (int i = 0; i < 500; ++i) {
      const Vec<2> x = cartesian<2>({std::uniform_real_distribution(0.199, 0.341)(random),
                                     std::uniform_real_distribution(-7.0, 7.0)(random)});
      const auto value = zero.at(x);
      EXPECT_NEAR(value.psi, 0.3 * x[0] - 0.8 * x[1] + 0.05, 1e-13);
      EXPECT_NEAR(value.gradient[0], 0.3, 1e-11);
      EXPECT_NEAR(value.gradient[1], -0.8, 1e-11);
    }
    const auto found = zero.projection({0.26, 0.16});
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found)[0], 0.26 - 0.3 * 0 / 0.73, 0.003);
    EXPECT_NEAR(0.3 * (*found)[0] - 0.8 * (*found)[1] + 0.05, 0, 1e-13);
  }
}

TEST(FitOutline, CircularHolesBecomeCirclesWhereTheyAre) {
  const PolarGrid<2> grid = wheel(7, 56, 1540);
  const Outline outline = outline_of(holes(grid, 2, different_holes));
  ASSERT_EQ(outline.loops.size(), 2U + 7 * 3);
  EXPECT_EQ(count(outline).splines, 0);
  for (int sector = 0; sector < grid.n_sectors; ++sector) {
    for (const Hole& hole : different_holes) {
      const Vec<2> centre = cartesian<2>({hole.centre_radius, hole.azimuth + sector * grid.sector_angle()});
      const auto is_it = [&](const Loop& loop) {
        const auto& arc = std::get<Arc>(loop.curves.front());
        return distance(arc.centre, centre) < 2e-6 && std::abs(arc.radius - hole.radius) < 2e-6 &&
               arc.sweep < 0 && loop.kind == LoopKind::hole;
      };
      EXPECT_EQ(std::ranges::count_if(outline.loops, is_it), 1);
    }
  }
}

TEST(FitOutline, AnySmoothHoleIsFollowedAndItsAreaKept) {
  for (const int degree : {1, 2}) {
    for (const double within : {5e-6, 2e-5, 1e-4}) {
      const LevelSet<2> psi = crooked_hole(wheel(16), degree);
      const Outline outline = outline_of(psi, within);
      EXPECT_EQ(outline.loops.size(), 18U);
      const auto report = check_outline(outline, psi, within);
      ASSERT_TRUE(report) << report.failure().front().what;
      EXPECT_LE(report->deviation, within);
      EXPECT_LT(std::abs(report->area_error), 0.2 * within);
    }
  }
}

TEST(FitOutline, CurvesOfASectorAreRepeatedExactly) {
  const Outline outline = outline_of(crooked_hole(wheel(12), 2));
  const auto& first = std::get<Spline>(outline.loops[2].curves.front());
  for (int sector = 0; sector < 12; ++sector) {
    const auto& spline = std::get<Spline>(outline.loops[2 + sector].curves.front());
    EXPECT_EQ(spline.knots, first.knots);
    for (std::size_t i = 0; i < first.points.size(); ++i)
      EXPECT_LT(distance(spline.points[i], rotated<2>(first.points[i], sector * 2 * pi / 12)), 1e-16 * 10);
  }
}

/// The same wheel, described by one sector that is the whole ring.
LevelSet<2> as_one_sector(const LevelSet<2>& psi) {
  PolarGrid<2> grid = psi.lattice.grid();
  grid.cells[1] *= grid.n_sectors;
  grid.n_sectors = 1;
  LevelSet<2> one{Lattice<2>(grid, psi.lattice.degree()), {}};
  for (int s = 0; s < psi.lattice.grid().n_sectors; ++s)
    one.values.insert(one.values.end(), psi.values.begin(), psi.values.end());
  return one;
}

TEST(FitOutline, OneSectorGivesTheSameWheel) {
  const LevelSet<2> psi = crooked_hole(wheel(8), 2);
  const Outline outline = outline_of(psi), one = outline_of(as_one_sector(psi));
  EXPECT_EQ(one.loops.size(), outline.loops.size());
  EXPECT_NEAR(material_area(one), material_area(outline), 1e-6 * material_area(outline));
  const auto report = check_outline(one, psi, tolerance);
  EXPECT_TRUE(report) << report.failure().front().what;
}

TEST(FitOutline, CornersAreKept) {
  // psi = w - |r - r_0| - R |azimuth - azimuth_0| with r_0 and azimuth_0 on lines of the grid.
  const PolarGrid<2> grid = wheel(16);
  const double r_0 = 0.27, azimuth_0 = 12 * grid.column_angle(), w = 0.0223, scale = 0.25;
  LevelSet<2> psi{Lattice<2>(grid, 2), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> polar = psi.lattice.polar_point(i);
    psi.values.push_back(w - std::abs(polar[0] - r_0) - scale * std::abs(polar[1] - azimuth_0));
  }
  const Outline outline = outline_of(psi);
  const Loop& hole = outline.loops.at(2);
  ASSERT_EQ(hole.curves.size(), 4U);
  for (const Vec<2>& corner : {Vec<2>{r_0 + w, azimuth_0}, Vec<2>{r_0 - w, azimuth_0},
                               Vec<2>{r_0, azimuth_0 + w / scale}, Vec<2>{r_0, azimuth_0 - w / scale}})
    EXPECT_EQ(std::ranges::count_if(
                  hole.curves,
                  [&](const Curve& curve) { return distance(start_of(curve), cartesian<2>(corner)) < 1e-8; }),
              1);
  EXPECT_TRUE(check_outline(outline, psi, tolerance));
}

TEST(FitOutline, AHoleThroughTheTreadIsRefusedWithItsPlace) {
  const auto outline = fit_outline(holes(wheel(16), 2, {{0.31, 0.1, 0.04}}), tolerance);
  ASSERT_FALSE(outline);
  EXPECT_NE(outline.failure().what.find("radius 340.0 mm"), std::string::npos) << outline.failure().what;
  EXPECT_FALSE(fit_outline(holes(wheel(16), 2, {{0.22, 0.1, 0.03}}), tolerance));
}

// --- Checks ---------------------------------------------------------------------------------------------

class BrokenOutline : public ::testing::Test {
 protected:
  /// Holes that differ, one of them far from the others, which the tests break.
  LevelSet<2> psi = holes(wheel(7, 28, 378), 2, different_holes);
  Outline outline = outline_of(psi);

  std::string faults() const {
    const auto report = check_outline(outline, psi, tolerance);
    std::string all;
    if (!report)
      for (const OutlineFault& fault : report.failure()) all += fault.what + "\n";
    return all;
  }
  Arc& hole() { return std::get<Arc>(outline.loops[2].curves.front()); }
};

TEST_F(BrokenOutline, SoundBeforeItIsBroken) { EXPECT_EQ(faults(), ""); }

TEST_F(BrokenOutline, OpenLoop) {
  hole().sweep *= 0.999;
  EXPECT_NE(faults().find("the hole is open by"), std::string::npos) << faults();
}

TEST_F(BrokenOutline, WrongSense) {
  outline.loops[2].curves.front() = reversed(outline.loops[2].curves.front());
  EXPECT_NE(faults().find("the material is not on the left of the hole at"), std::string::npos) << faults();
  outline.loops[0].curves.front() = reversed(outline.loops[0].curves.front());
  EXPECT_NE(faults().find("the outer_edge has the wrong orientation"), std::string::npos) << faults();
}

TEST_F(BrokenOutline, CrossingLoops) {
  // The first hole's circle and another, of the same radius, half a radius to the right, cross twice.
  const Vec<2> centre = hole().centre;
  const double radius = hole().radius;
  outline.loops.push_back({LoopKind::hole, {circle(centre[0] + radius / 2, centre[1], radius, -2 * pi)}});
  const Vec<2> crossing{centre[0] + radius / 4, centre[1] + radius * std::sqrt(15.0) / 4};
  EXPECT_NE(faults().find("edges cross or touch at " + place_of(crossing)), std::string::npos) << faults();
}

TEST_F(BrokenOutline, LoopThatCrossesItself) {
  const Vec<2> c = hole().centre;
  const auto p = [&](double x, double y) { return Vec<2>{c[0] + x, c[1] + y}; };
  const auto side = [&](double x, double y, double u, double v) { return Line{p(x, y), p(u, v)}; };
  outline.loops[2].curves = {side(-0.01, -0.01, 0.01, 0.01), side(0.01, 0.01, 0.01, -0.01),
                             side(0.01, -0.01, -0.01, 0.01), side(-0.01, 0.01, -0.01, -0.01)};
  EXPECT_NE(faults().find("edges cross or touch at " + place_of(c)), std::string::npos) << faults();
}

TEST_F(BrokenOutline, MovedMissingAndAdditionalLoops) {
  const Outline sound = outline;
  hole().radius += 1.1 * tolerance;
  EXPECT_NE(faults().find("curve and contour are"), std::string::npos) << faults();
  outline = sound;
  outline.loops.erase(outline.loops.begin() + 3);
  EXPECT_NE(faults().find("curve and contour are"), std::string::npos) << faults();
  EXPECT_NE(faults().find("from that of the level set; decrease --tolerance"), std::string::npos) << faults();
  outline = sound;
  outline.loops.push_back({LoopKind::hole, {circle(0.21, 0.11, 0.003, -2 * pi)}});
  EXPECT_NE(faults().find("curve and contour are"), std::string::npos) << faults();
}

/// The part is the curve itself, at the parameters of the part.
TEST(CutOutline, ASplineIsCutExactly) {
  for (const Curve& curve : sample_curves())
    for (const auto& [s0, s1] : {std::pair{0.0, 0.13}, {0.05, 0.19}, {0.1, 0.9}, {0.2, 0.7}, {0.31, 1.0}}) {
      const Curve piece = part(curve, s0, s1);
      for (const double t : {0.0, 0.21, 0.5, 0.83, 1.0}) {
        const auto [place, velocity] = at(piece, t);
        const auto whole = at(curve, s0 + t * (s1 - s0));
        EXPECT_LT(distance(place, whole.position), 1e-14 * 5) << t;
        EXPECT_LT(distance(velocity, (s1 - s0) * whole.velocity), 1e-12) << t;
      }
    }
}

/// Checks that every curve starts where the last one ends and that the material is on the left of all.
void expect_closed_and_oriented(const Outline& outline, const LevelSet<2>& psi, double inner, double outer) {
  for (const Loop& loop : outline.loops) {
    const Curve* before = &loop.curves.back();
    for (const Curve& curve : loop.curves) {
      EXPECT_LT(distance(start_of(curve), end_of(*before)), 1e-9 * 0.34);
      before = &curve;
      const auto [place, velocity] = at(curve, 0.4);
      if (norm(velocity) < 1e-4) continue;
      const Vec<2> inside = place + 2e-4 / norm(velocity) * Vec<2>{-velocity[1], velocity[0]};
      EXPECT_GT(norm(inside), inner);
      EXPECT_LT(norm(inside), outer);
      EXPECT_LT(ZeroContour(psi).at(inside).psi, 0) << place_of(place);
    }
  }
}

/// Holes across one circle, across two, and across none; circles through smooth holes and through spokes.
TEST(CutOutline, PartsAreClosedAndAddUp) {
  for (const auto& radii : {std::vector{0.27}, {0.245, 0.29}, {0.2661, 0.2662, 0.31}, {0.21}})
    for (const LevelSet<2>& psi :
         {holes(wheel(7), 2, different_holes), crooked_hole(wheel(8), 2), crooked_hole(wheel(1), 2)}) {
      SCOPED_TRACE(radii.front());
      const Outline whole = outline_of(psi);
      const auto parts = cut_by_circles(whole, radii);
      ASSERT_TRUE(parts) << parts.failure().what;
      ASSERT_EQ(parts->size(), radii.size() + 1);
      double sum = 0;
      for (std::size_t k = 0; k < parts->size(); ++k) {
        const double inner = k == 0 ? 0.20 : radii[k - 1], outer = k < radii.size() ? radii[k] : 0.34;
        if (outer - inner > 1e-3) expect_closed_and_oriented((*parts)[k], psi, inner, outer);
        sum += material_area((*parts)[k]);
        int n_bodies = 0;
        for (const Body& body : bodies((*parts)[k])) n_bodies += signed_area(*body.edge) > 0;
        EXPECT_GT(n_bodies, 0);
        for (const Loop& loop : (*parts)[k].loops)
          EXPECT_EQ(signed_area(loop) > 0,
                    loop.kind == LoopKind::outer_edge || loop.kind == LoopKind::island);
      }
      EXPECT_NEAR(sum / material_area(whole), 1, 1e-12);
    }
}

/// Circles through round holes cut segments of circles from the ring.
TEST(CutOutline, PartsHaveTheExactAreas) {
  const double r = 0.03, at_radius = 0.27;
  const LevelSet<2> psi = holes(wheel(8), 2, {{at_radius, 0.3, r}});
  const auto parts = cut_by_circles(outline_of(psi), {at_radius});
  ASSERT_TRUE(parts);
  // The lens of a circle and a larger one through its middle.
  const double a = std::acos(r / (2 * at_radius)), b = std::acos(1 - r * r / (2 * at_radius * at_radius));
  const double lens = r * r * a + at_radius * at_radius * b - at_radius * r * std::sin(a);
  EXPECT_NEAR(material_area((*parts)[0]), pi * (at_radius * at_radius - 0.2 * 0.2) - 8 * lens, 1e-6);
  EXPECT_EQ((*parts)[0].loops.size(), 2u);
}

TEST(Triangulation, CoversTheRegionAndFindsCrossings) {
  const std::vector<Polygon> square_in_square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                              {{1, 1}, {1, 2}, {3, 2}, {3, 1}}};
  EXPECT_TRUE(crossings(square_in_square).empty());
  const Triangulation triangulation = triangulated(square_in_square);
  EXPECT_EQ(triangulation.triangles.size(), 8U);
  double area = 0;
  for (const auto& [i, j, k] : triangulation.triangles) {
    const Vec<2>&a = triangulation.points[i], &b = triangulation.points[j], &c = triangulation.points[k];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_DOUBLE_EQ(area, 14);
  const std::vector<Polygon> eight{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}};
  EXPECT_EQ(crossings(eight), (std::vector<Vec<2>>{{1, 1}}));
  const std::vector<Polygon> touching{{{0, 0}, {2, 0}, {2, 2}}, {{2, 1}, {3, 0}, {3, 2}}};
  EXPECT_EQ(crossings(touching), (std::vector<Vec<2>>{{2, 1}}));
}

// --- Walls and gaps -------------------------------------------------------------------------------------

constexpr double step = 2e-4;

Outline ring_with(std::vector<Loop> loops) {
  Outline outline{
      {{LoopKind::outer_edge, {circle(0, 0, 0.34, 2 * pi)}}, {LoopKind::bore, {circle(0, 0, 0.2, -2 * pi)}}}};
  outline.loops.insert(outline.loops.end(), loops.begin(), loops.end());
  return outline;
}

Loop round_hole(double x, double y, double radius) {
  return {LoopKind::hole, {circle(x, y, radius, -2 * pi)}};
}

TEST(Clearances, BetweenCirclesAreExact) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<Loop> loops;
    double wall = 0.14, gap = INFINITY;
    for (int i = 0; i < 12; ++i) {
      const double r = 0.006 + 0.012 * uniform(random), azimuth = i * pi / 6 + 0.2 * uniform(random);
      const double distance_of_centre = 0.202 + r + (0.136 - 2 * r) * uniform(random);
      const Vec<2> c = cartesian<2>({distance_of_centre, azimuth});
      wall = std::min({wall, distance_of_centre - r - 0.2, 0.34 - distance_of_centre - r});
      for (const Loop& other : loops) {
        const auto& arc = std::get<Arc>(other.curves.front());
        wall = std::min(wall, distance(arc.centre, c) - arc.radius - r);
      }
      gap = std::min(gap, 2 * r);
      loops.push_back(round_hole(c[0], c[1], r));
    }
    const Clearances found = clearances(ring_with(loops), 1, step);
    ASSERT_TRUE(found.wall && found.gap);
    EXPECT_NEAR(found.wall->width, wall, 1e-9);
    EXPECT_NEAR(found.gap->width, gap, 1e-9);
  }
}

TEST(Clearances, OfARingIsItsThickness) {
  const Clearances found = clearances(ring_with({}), 5, step);
  ASSERT_TRUE(found.wall);
  EXPECT_NEAR(found.wall->width, 0.14, 1e-9);
  EXPECT_FALSE(found.gap);
}

TEST(Clearances, NeckOfAHoleIsItsGap) {
  // Two circles of 20 mm, 50 mm apart, joined by fillets of 40 mm: the centres of a fillet and of the circles
  // make a triangle with sides 60, 60 and 50.
  const double half = 0.025, big = 0.02, fillet = 0.04,
               height = std::sqrt(std::pow(big + fillet, 2) - half * half);
  const double x = 0.27, turn = std::atan2(height, half);
  const auto arc = [&](double y, double z, double r, double begin, double sweep) {
    return Arc{{x + z, y}, r, begin, sweep};
  };
  // Clockwise, with the long axis along y.
  const double open = std::atan2(half, height);
  const Loop hole{
      LoopKind::hole,
      {arc(half, 0, big, 3 * pi / 2 - turn, -2 * (pi - turn)), arc(0, height, fillet, pi - open, 2 * open),
       arc(-half, 0, big, pi / 2 - turn, -2 * (pi - turn)), arc(0, -height, fillet, -open, 2 * open)}};
  for (std::size_t i = 0; i < 4; ++i)
    ASSERT_LT(distance(end_of(hole.curves[i]), start_of(hole.curves[(i + 1) % 4])), 1e-12) << i;
  const Clearances found = clearances(ring_with({hole}), 1, step);
  ASSERT_TRUE(found.gap);
  EXPECT_NEAR(found.gap->width, 2 * (height - fillet), 1e-9);
  EXPECT_LT(
      distance({(found.gap->from[0] + found.gap->to[0]) / 2, (found.gap->from[1] + found.gap->to[1]) / 2},
               {x, 0}),
      1e-6);
}

// The ends bend more tightly than the wall between them is wide.
TEST(Clearances, BetweenTheEndsOfSlotsAreExact) {
  constexpr int n = 12;
  for (const double r : {0.0003, 0.001, 0.004, 0.008}) {
    std::vector<Loop> loops;
    double wall = INFINITY;
    for (int i = 0; i < n; ++i) {
      const double azimuth = 2 * pi * i / n + 0.037;
      const Vec<2> c = cartesian<2>({0.27, azimuth}), along = cartesian<2>({1, azimuth + pi / 2}),
                   across = cartesian<2>({1, azimuth});
      const auto at = [&](double u, double v) {
        return Vec<2>{c[0] + u * along[0] + v * across[0], c[1] + u * along[1] + v * across[1]};
      };
      const double half = 0.27 * std::tan(pi / n) - 0.006 - r;
      wall = 2 * 0.006 * std::cos(pi / n) - 2 * r * (1 - std::cos(pi / n));
      loops.push_back({LoopKind::hole,
                       {Arc{at(half, 0), r, azimuth + pi, -pi}, Line{at(half, r), at(-half, r)},
                        Arc{at(-half, 0), r, azimuth, -pi}, Line{at(-half, -r), at(half, -r)}}});
    }
    const auto found = clearances(ring_with(loops), n, step).wall;
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->width, wall, 1e-9) << r;
  }
}

TEST(Clearances, OfATriangularHoleIsItsInscribedCircle) {
  const Vec<2> a{0.25, -0.02}, b{0.25, 0.02}, c{0.29, 0};
  const Outline outline = ring_with({{LoopKind::hole, {Line{a, b}, Line{b, c}, Line{c, a}}}});
  const double side = std::hypot(0.04, 0.02), inscribed = 2 * 0.5 * 0.04 * 0.04 / (0.04 + 2 * side);
  const auto found = clearances(outline, 1, step).gap;
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->width, 2 * inscribed, 1e-5);
}

TEST(Clearances, BetweenPointedHolesAreThatOfTheirCorners) {
  const auto triangle = [](double x, double y, double u, double v, double w, double z) {
    const Vec<2> a{x, y}, b{u, v}, c{w, z};
    return Loop{LoopKind::hole, {Line{a, b}, Line{b, c}, Line{c, a}}};
  };
  const Outline outline = ring_with(
      {triangle(0.27, 0.001, 0.26, 0.02, 0.28, 0.02), triangle(0.271, -0.002, 0.28, -0.02, 0.26, -0.02)});
  const auto found = clearances(outline, 1, step).wall;
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->width, std::hypot(0.001, 0.003), 1e-9);
}

}  // namespace
}  // namespace wheelwright
