#include <gtest/gtest.h>

#include <numbers>

#include "tests/support.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

struct HertzContact {
  double peak_pressure, half_width, approach;
};

/// A solid disc between two flats: half of the ring, its faces identified, so that every field repeats itself
/// after half a turn. The rim is a rigid pin of 1 mm at the centre, which does not move; it disturbs the
/// solution by (1/340)^2.
HertzContact squeeze_disc(double load, const Material& material, int radial_cells, int columns,
                          const TreadGrid& refinement) {
  const PolarGrid<2> grid{0.001, 0.34, 0.12, 2, {radial_cells, columns}};
  const ElementTable<2> table(grid, 2, material, {});
  const auto tread = Tread<2>::condense(table, refinement, {}, 5);
  EXPECT_TRUE(tread);
  const SectorHarmonics half_turn(1);
  const CutDomain<2> full{grid, std::vector<CellKind>(grid.n_cells(), CellKind::inside), {}, {}};
  const auto ring = CyclicStiffness<2>::factor(
      sector_stiffness<2>(full, table, radial_cells - refinement.rows),
      [&](int harmonic) { return tread->outer_stiffness(half_turn, harmonic); }, half_turn);
  EXPECT_TRUE(ring);
  const auto contact =
      reduced_contact<2>({*ring, *tread, 3}, *tread, grid, {0}, {-2, 4}, std::make_shared<CoulombLaw<2>>(0),
                         {{}, {{{.towards_ground = 1}, load}}});
  const ContactUnknowns<2> guess = hertz_start(contact, load, 0.34, material.contact_modulus());
  const auto state = solve_contact<2>(contact, std::span(&guess, 1));
  EXPECT_TRUE(state);

  // p^2 = p0^2 (1 - x^2 / a^2): a straight line in x^2.
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < contact.n_points(); ++i) {
    const double x = std::pow(contact.points()[i].position[1], 2), y = std::pow(state->traction[i][0], 2);
    if (std::abs(contact.points()[i].position[1]) > 0.9 * 6.39e-3) continue;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
  return {std::sqrt(start), std::sqrt(-start / slope), state->rim.towards_ground};
}

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

}  // namespace
}  // namespace wheelwright
