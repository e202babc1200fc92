#include "wheelwright/mechanics/state/material_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wheelwright {
namespace {

constexpr double hole_radius = 0.03, mid_radius = 0.27, first_azimuth = 0.2, second_azimuth = 0.55;

/// One sector, so that the shape has no symmetry.
PolarGrid<2> grid() { return {0.20, 0.34, 0.12, 1, {14, 192}}; }

Vec<2> centre(double azimuth) { return cartesian<2>({mid_radius, azimuth}); }

/// Two round holes.
LevelSet<2> two_holes() {
  const Lattice<2> lattice(grid(), 2);
  LevelSet<2> psi{lattice, {}};
  for (int k = 0; k < lattice.n_nodes(); ++k) {
    const Vec<2> x = cartesian<2>(lattice.polar_point(k));
    psi.values.push_back(hole_radius -
                         std::min(distance(x, centre(first_azimuth)), distance(x, centre(second_azimuth))));
  }
  return psi;
}

/// Moves what is near the first hole by `shift`, and leaves the second one.
RingField moved_hole(const Lattice<2>& lattice, const Vec<2>& shift) {
  constexpr double rigid = 1.2 * hole_radius;
  RingField u{2, std::vector<double>(2 * lattice.n_nodes())};
  for (int k = 0; k < lattice.n_nodes(); ++k)
    if (distance(cartesian<2>(lattice.polar_point(k)), centre(first_azimuth)) < rigid)
      std::copy_n(shift.begin(), 2, &u.values[2 * k]);
  return u;
}

TEST(MaterialEdges, FindsWhereAndWhenTwoHolesMeetFirst) {
  const LevelSet<2> psi = two_holes();
  const MaterialEdges<2> edges(psi, psi.lattice);
  const Vec<2> apart = centre(second_azimuth) - centre(first_azimuth), along = (1 / norm(apart)) * apart;
  const double gap = norm(apart) - 2 * hole_radius;
  const RingField to = moved_hole(psi.lattice, 2 * gap * along);
  ASSERT_TRUE(edges.overlap(to));
  const auto found = edges.first_crossing(to);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->share, 0.5, 0.02);
  const Vec<2> facing_first = centre(first_azimuth) + hole_radius * along,
               facing_second = centre(second_azimuth) - hole_radius * along;
  const bool is_swapped = distance(found->on_one, facing_first) > distance(found->on_one, facing_second);
  EXPECT_LT(distance(is_swapped ? found->on_other : found->on_one, facing_first), 0.2 * hole_radius);
  EXPECT_LT(distance(is_swapped ? found->on_one : found->on_other, facing_second), 0.2 * hole_radius);

  const RingField from = moved_hole(psi.lattice, 0.5 * gap * along);
  const auto later = edges.first_crossing(from, to);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->share, (1 - 0.5) / (2 - 0.5), 0.02);
}

TEST(MaterialEdges, FindsNothingWhereHolesStayApart) {
  const LevelSet<2> psi = two_holes();
  const MaterialEdges<2> edges(psi, psi.lattice);
  const Vec<2> apart = centre(second_azimuth) - centre(first_azimuth);
  const double nearly = 0.95 * (1 - 2 * hole_radius / norm(apart));
  EXPECT_FALSE(edges.overlap(moved_hole(psi.lattice, nearly * apart)));
  EXPECT_FALSE(edges.first_crossing(moved_hole(psi.lattice, nearly * apart)));
}

}  // namespace
}  // namespace wheelwright
