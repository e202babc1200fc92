#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/support.h"
#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

/// Pressures at the contact points, by the square of their distance from the middle of the patch.
struct SqueezedDisc {
  std::vector<std::pair<double, double>> pressures;  ///< [m^2], [Pa]
  double approach;                                   ///< of the centre to a flat [m]
};

/// The straight line through p^2 over x^2 at points at these distances from the middle [m]; p there, and the
/// distance at which it is zero.
struct PressureLine {
  double peak_pressure, half_width;
};
PressureLine pressure_line(const SqueezedDisc& disc, double from, double to) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [x, p] : disc.pressures) {
    if (x < from * from || x > to * to) continue;
    const double y = p * p;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
  return {std::sqrt(start), std::sqrt(-start / slope)};
}

/// A solid disc between two flats: half of the ring, its faces identified, so that every field repeats itself
/// after half a turn. The rim is a rigid pin of 1 mm at the centre, which does not move; it disturbs the
/// solution by (1/340)^2. `modulus`: E* for the first guess of the patch.
SqueezedDisc squeeze_disc(double load, const Materials<2>& materials, double modulus,
                          const PolarGrid<2>& grid, const TreadGrid& refinement) {
  const ElementTable<2> table(grid, 2, materials, {});
  const auto tread = Tread<2>::condense(table, refinement, {}, 5);
  EXPECT_TRUE(tread);
  const SectorHarmonics half_turn(1);
  const CutDomain<2> full{grid, std::vector<CellKind>(grid.n_cells(), CellKind::inside), {}, {}};
  const auto ring = CyclicStiffness<2>::factor(
      sector_stiffness<2>(full, table, grid.cells[0] - refinement.rows),
      [&](int harmonic) { return tread->outer_stiffness(half_turn, harmonic); }, half_turn);
  EXPECT_TRUE(ring);
  const auto contact =
      reduced_contact<2>({*ring, *tread, 3}, *tread, grid, {0}, {-2, 4}, std::make_shared<CoulombLaw<2>>(0),
                         {{}, {{{.towards_ground = 1}, load}}});
  const ContactUnknowns<2> guess = hertz_start(contact, load, 0.34, modulus);
  const auto state = solve_contact<2>(contact, std::span(&guess, 1));
  EXPECT_TRUE(state);
  SqueezedDisc disc{{}, state->rim.towards_ground};
  for (int i = 0; i < contact.n_points(); ++i)
    disc.pressures.emplace_back(std::pow(contact.points()[i].position[1], 2), state->traction[i][0]);
  return disc;
}

struct HertzContact {
  double peak_pressure, half_width, approach;
};

/// Of one material: p^2 = p0^2 (1 - x^2 / a^2).
HertzContact squeeze_disc(double load, const Material& material, int radial_cells, int columns,
                          const TreadGrid& refinement) {
  const SqueezedDisc disc = squeeze_disc(load, material, material.contact_modulus(),
                                         {0.001, 0.34, 0.12, 2, {radial_cells, columns}}, refinement);
  const auto [peak_pressure, half_width] = pressure_line(disc, 0, 0.9 * 6.39e-3);
  return {peak_pressure, half_width, disc.approach};
}

/// A layer bonded to a half-plane, plane strain, without friction.
struct LayeredHalfPlane {
  Material layer, below;
  double thickness;  ///< [m]

  /// By how much the normal displacement under a pressure cos(k x) exceeds that of a half-plane of the
  /// layer's material, in units of it: T. C. O'Sullivan, R. B. King, J. Tribology 110 (1988), 235-240, in two
  /// dimensions.
  double excess(double k) const {
    const double stiffer = layer.mu() / below.mu(), nu = layer.poissons_ratio,
                 lambda = 1 - 4 * (1 - nu) / (1 + stiffer * (3 - 4 * below.poissons_ratio)),
                 kappa = (stiffer - 1) / (stiffer + 3 - 4 * nu), depth = k * thickness;
    const double once = std::exp(-2 * depth), twice = once * once;
    return (1 + 4 * depth * kappa * once - lambda * kappa * twice) /
               (1 - (lambda + kappa + 4 * kappa * depth * depth) * once + lambda * kappa * twice) -
           1;
  }
};

/// The contact of a rigid cylinder with it by a Fourier integral and Gauss-Chebyshev quadrature (F. Erdogan,
/// G. D. Gupta, Quart. Appl. Math. 29, 1972): the displacement of a line load on the surface is
///   -2 / (pi E1) log |x| - d / pi log sqrt(x^2 + h^2) + 1 / pi int_0^inf smooth(k) cos(k x) dk,
/// E1 and E2 the moduli E* of layer and half-plane, d = 2 / E2 - 2 / E1: the second term has the far field of
/// the half-plane without its layer.
class LayeredContact {
 public:
  LayeredContact(const LayeredHalfPlane& body, double radius, int points)
      : body_(body), radius_(radius), points_(points) {
    const GaussRule gauss = gauss_rule(8);
    const double step = 0.5 / body.thickness;
    for (int part = 0; part < 60; ++part)
      for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double k = (part + gauss.points[q]) * step;
        waves_.push_back(
            {k, gauss.weights[q] * step / pi *
                    (of_layer() * body_.excess(k) - of_difference() * std::exp(-k * body.thickness)) / k});
      }
  }

  /// For the half-width a [m]: the load per width [N/m], the pressure in the middle, and the approach of a
  /// cylinder of the lower material to it, at the centre of which a half-plane's infinite displacement is 2 P
  /// / (pi E2) (log(2 R) - 1) (as Johnson's (5.57) says).
  struct Solution {
    double load, peak_pressure, approach, half_width;
    std::vector<double> g;  ///< at the nodes: the pressure is g sqrt(1 - (x / a)^2)

    double pressure(double x) const {
      const double s = x / half_width;
      return std::abs(s) < 1 ? std::sqrt(1 - s * s) * interpolated(s) : 0;
    }
    /// g between the nodes, the zeros of a Chebyshev polynomial of the second kind, by barycentric
    /// interpolation.
    double interpolated(double s) const {
      const int n = static_cast<int>(g.size());
      double sum = 0, weights = 0;
      for (int i = 0; i < n; ++i) {
        const double angle = pi * (i + 1) / (n + 1), from_node = s - std::cos(angle);
        if (std::abs(from_node) < 1e-14) return g[i];
        const double w = (i % 2 == 0 ? 1 : -1) * std::pow(std::sin(angle), 2) / from_node;
        sum += w * g[i];
        weights += w;
      }
      return sum / weights;
    }
  };
  Solution at(double a) const {
    const int half = (points_ + 1) / 2;  // the pressure is even; points_ is odd
    const auto node = [&](int i) { return std::cos(pi * (i + 1) / (points_ + 1)); };
    const auto weight = [&](int i) {
      return pi * std::pow(std::sin(pi * (i + 1) / (points_ + 1)), 2) / (points_ + 1);
    };
    Matrix m(half, half), b(half, 1);
    for (int j = 0; j < half; ++j) {
      const double x = std::cos(pi * (2 * j + 1) / (2 * (points_ + 1)));
      for (int i = 0; i < points_; ++i)
        m(j, std::min(i, points_ - 1 - i)) += weight(i) * a * -slope(a * (x - node(i)));
      b(j, 0) = a * x / radius_;
    }
    const Matrix g = LuFactor::factor(std::move(m))->solve(std::move(b));
    Solution result{0, g(half - 1, 0), 0, a, {}};
    for (int i = 0; i < points_; ++i) {
      result.g.push_back(g(std::min(i, points_ - 1 - i), 0));
      result.load += a * weight(i) * result.g.back();
    }
    // s = t^3 resolves the logarithm.
    const GaussRule gauss = gauss_rule(8);
    constexpr int parts = 40;
    for (int part = 0; part < parts; ++part)
      for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double t = (part + gauss.points[q]) / parts, s = t * t * t;
        result.approach += 2 * gauss.weights[q] / parts * 3 * t * t * a * std::sqrt(1 - s * s) *
                           result.interpolated(s) * displacement(a * s);
      }
    result.approach += of_below() * result.load / pi * (std::log(2 * radius_) - 1);
    return result;
  }

  /// The half-width for a load.
  double half_width(double load) const {
    double low = 1e-3 * body_.thickness, high = 10 * body_.thickness;
    for (int k = 0; k < 60; ++k) (at(0.5 * (low + high)).load < load ? low : high) = 0.5 * (low + high);
    return low;
  }

 private:
  double of_layer() const { return 2 / body_.layer.contact_modulus(); }
  double of_below() const { return 2 / body_.below.contact_modulus(); }
  double of_difference() const { return of_below() - of_layer(); }

  /// Of the surface under a line load of 1 N/m at the distance x [m per N/m], and its derivative.
  double displacement(double x) const {
    double sum = -of_layer() / pi * std::log(std::abs(x)) -
                 of_difference() / pi * 0.5 * std::log(x * x + body_.thickness * body_.thickness);
    for (const auto& [k, weight] : waves_) sum += weight * std::cos(k * x);
    return sum;
  }
  double slope(double x) const {
    double sum =
        -of_layer() / (pi * x) - of_difference() / pi * x / (x * x + body_.thickness * body_.thickness);
    for (const auto& [k, weight] : waves_) sum -= weight * k * std::sin(k * x);
    return sum;
  }

  LayeredHalfPlane body_;
  double radius_;
  int points_;
  std::vector<std::pair<double, double>> waves_;  ///< k, and the weight of cos(k x)
};

/// With E* = E.
TEST(Hertz, ADiscOfSheetBetweenTwoFlats) {
  const Material material{200e6, 0.48, Plane::stress};
  const double load = 24525, radius = 0.34, modulus = 200e6;
  const double a = 2 * std::sqrt(load * radius / (pi * modulus)), p0 = 2 * load / (pi * a);
  const auto disc = squeeze_disc(load, material, 28, 84, {2, 4, 0});  // +0.03, +0.005 % here
  EXPECT_NEAR(disc.peak_pressure, p0, 2e-3 * p0);
  EXPECT_NEAR(disc.half_width, a, 2e-3 * a);
}

TEST(Hertz, ADiscBetweenTwoFlats) {
  const Material material{200e6, 0.48};
  const double load = 24525, radius = 0.34, modulus = material.contact_modulus();
  const double a = 2 * std::sqrt(load * radius / (pi * modulus)), p0 = 2 * load / (pi * a);
  const double approach = load / (pi * modulus) * (2 * std::log(4 * radius / a) - 1);  // Johnson, (5.57)
  ASSERT_NEAR(a, 6.39170e-3, 1e-8);
  ASSERT_NEAR(p0, 2.442714e6, 1);
  ASSERT_NEAR(approach, 0.291999e-3, 1e-9);

  const auto coarse = squeeze_disc(load, material, 28, 84,
                                   {2, 4, 0});  // cells of a/8 at the contact: -0.03, +0.3, -0.04 % here
  EXPECT_NEAR(coarse.peak_pressure, p0, 0.01 * p0);
  EXPECT_NEAR(coarse.half_width, a, 0.01 * a);
  EXPECT_NEAR(coarse.approach, approach, 1e-3 * approach);
  const auto fine = squeeze_disc(load, material, 56, 168, {4, 4, 0});  // a/16: +0.01, -0.06, -0.004 %
  EXPECT_NEAR(fine.peak_pressure, p0, 2e-3 * p0);
  EXPECT_NEAR(fine.half_width, a, 2e-3 * a);
  EXPECT_NEAR(fine.approach, approach, 3e-4 * approach);
}

/// The reference is that of Hertz for layers of one material, and converges.
TEST(LayeredContact, OfOneMaterialIsThatOfHertz) {
  const Material material{200e6, 0.48};
  const LayeredContact contact({material, {200e6, 0.48}, 2e-3}, 0.34, 21);
  const double a = 6.39170e-3;
  const auto solution = contact.at(a);
  EXPECT_NEAR(solution.load / 24525, 1, 1e-5);
  EXPECT_NEAR(solution.peak_pressure / 2.442714e6, 1, 1e-5);
  EXPECT_NEAR(solution.approach / 0.291999e-3, 1, 1e-5);
  EXPECT_NEAR(contact.half_width(24525) / a, 1, 1e-5);
  for (const double contrast : {0.1, 20.0}) {
    const LayeredHalfPlane body{{200e6 * contrast, 0.3}, {200e6, 0.4}, 2e-3};
    const auto few = LayeredContact(body, 0.34, 15).at(2e-3), many = LayeredContact(body, 0.34, 31).at(2e-3);
    EXPECT_NEAR(few.load / many.load, 1, 1e-7);
    EXPECT_NEAR(few.peak_pressure / many.peak_pressure, 1, 1e-7);
    EXPECT_NEAR(few.approach / many.approach, 1, 1e-7);
  }
}

/// A disc with a layer of 2 mm: its curvature and the ring that the layer forms change the half-plane's
/// numbers by about the ratio 0.006 of thickness to radius, times the contrast for the travel. Rows of
/// unequal height resolve what is below the layer.
TEST(LayeredContact, OfADiscIsThatOfALayeredHalfPlane) {
  const double thickness = 2e-3, radius = 0.34;
  PolarGrid<2> grid{0.001, radius, 0.12, 2, {46, 600}};
  grid.fixed_lines = {{12, 0.2}, {25, 0.3}, {35, 0.33}, {44, radius - thickness}};
  for (const auto& [layer, below, load] : {std::tuple{Material{20e6, 0.4}, Material{200e6, 0.3}, 1500.0},
                                           {Material{20e6, 0.49}, Material{200e6, 0.3}, 1500.0},
                                           {Material{800e6, 0.3}, Material{200e6, 0.4}, 4000.0}}) {
    SCOPED_TRACE(layer.youngs_modulus);
    const LayeredContact reference({layer, below, thickness}, radius, 31);
    const double a = reference.half_width(load);
    const auto exact = reference.at(a);
    const Materials<2> materials(
        std::vector<Materials<2>::Layer>{{radius - thickness, std::make_shared<IsotropicLaw<2>>(below)},
                                         {radius, std::make_shared<IsotropicLaw<2>>(layer)}});
    const double like_hertz = 4 * load * radius / (pi * a * a);  // E* of a patch of this half-width
    const auto disc = squeeze_disc(load, materials, like_hertz, grid, {2, 4, 0});
    EXPECT_NEAR(pressure_line(disc, 0, 0.3 * a).peak_pressure / exact.peak_pressure, 1, 0.01);
    SqueezedDisc expected;
    for (const auto& [x2, p] : disc.pressures)
      expected.pressures.emplace_back(x2, exact.pressure(std::sqrt(x2)));
    const double half_width = pressure_line(disc, 0.7 * a, 0.95 * a).half_width /
                              pressure_line(expected, 0.7 * a, 0.95 * a).half_width;
    EXPECT_NEAR(half_width, 1, 0.01);
    EXPECT_NEAR(disc.approach / exact.approach, 1, 0.01);
    RecordProperty("travel", std::to_string(disc.approach / exact.approach - 1));
    RecordProperty("peak",
                   std::to_string(pressure_line(disc, 0, 0.3 * a).peak_pressure / exact.peak_pressure - 1));
    RecordProperty("half_width", std::to_string(half_width - 1));
  }
}

}  // namespace
}  // namespace wheelwright
