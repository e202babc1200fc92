#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/deformations.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright::testing {

struct ValueAndSteepness {
  double value, steepness;
};

/// A level set and |grad psi| at a point of a cell.
inline ValueAndSteepness both_at(const LevelSet<3>& psi, const std::array<int, 3>& cell, const Vec<3>& xi) {
  const PolarGrid<3>& g = psi.lattice.grid();
  const ShapeFunctions<3> shape(psi.lattice.degree(), xi);
  const auto values = psi.cell_values(g.cell_index(cell));
  ValueAndSteepness result{};
  Vec<3> gradient{};
  for (std::size_t a = 0; a < values.size(); ++a) {
    result.value += shape.value[a] * values[a];
    gradient += values[a] * shape.gradient[a];
  }
  const CellMap<3> map(g, psi.lattice.degree(), cell);
  result.steepness = norm<3>(transpose_times<3>(inverse<3>(map.jacobian(shape)), gradient));
  return result;
}

/// Whether the shape that can be made, kept within these bands, has after a small deformation the edges that
/// the motion with followers predicts, to second order; the motion without them must not predict it. `cells`:
/// of the smaller of two deformations.
inline void expect_taylor_order_of_kept_shapes(const Bands& bands, const LevelSet<3>& holes, double cells) {
  const Lattice<3>& lattice = holes.lattice;
  EvolutionOptions options{.velocity = {ExtensionKind::h1, 2}, .bands = bands};
  options.space = ShapeSpace::spline;
  options.deformation = DeformationKind::normal_speed;
  const Evolver<3> evolver(lattice, options);
  const auto psi =
      *evolver.move(evolver.keep_bands(holes), std::vector<double>(lattice.n_nodes(), 1.0), 1e-14);
  const auto samples = boundary_samples<3>(psi);
  const std::vector<SurfacePoint<3>> boundary(samples.begin(), samples.end());
  auto deformation = smooth_deformation<3>(lattice, 1);
  for (int node = 0; node < lattice.n_nodes(); ++node)
    deformation[node] *= std::cos(60 * lattice.polar_point(node)[2]);
  const auto free = evolver.deformations().motion_of(psi, boundary);
  const auto velocity = free.speeds_at_nodes(deformation);
  const double h = lattice.grid().resolution(), fastest = largest_magnitude(velocity);
  Following following;
  EXPECT_TRUE(evolver.follow_as_made(free.coefficients(), velocity, 1e-6 * h, following));
  const auto tied = free.following(psi, boundary, following);
  const auto remainder = [&](const BoundaryMotion<3>& motion, double by) {
    const double time = by * h / fastest;
    const auto moved = *evolver.move(psi, velocity, by * h);
    const auto speeds = motion.speeds(deformation);
    double square = 0;
    for (std::size_t q = 0; q < boundary.size(); ++q) {
      const auto& point = boundary[q];
      const auto cell = lattice.grid().cell_position(point.cell);
      if (evolver.at_bands(std::vector{point})[0]) continue;
      const auto [before, steepness] = both_at(psi, cell, point.xi);
      const double off = both_at(moved, cell, point.xi).value - before + time * speeds[q] * steepness;
      square += point.weight * off * off;
    }
    return std::sqrt(square);
  };
  const double large = remainder(tied, 2 * cells), small = remainder(tied, cells);
  EXPECT_GT(std::log2(large / small), 1.9) << large << ' ' << small;
  EXPECT_LT(std::log2(remainder(free, 2 * cells) / remainder(free, cells)), 1.5);
}

}  // namespace wheelwright::testing
