#include "wheelwright/shape/evolution/boundary_motion.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/deformations.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/deformation_space.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/moved_lines.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

template <int dim>
Lattice<dim> lattice_of(int degree, int refinement = 1) {
  if constexpr (dim == 2)
    return {{0.20, 0.34, 0.12, 12, {28 * refinement, 32 * refinement}}, degree};
  else
    return {{0.20, 0.34, 0.12, 12, {12 * refinement, 12 * refinement, 6}}, degree};
}

/// Rows of unequal height meet in the middle of the wall of thin_wall(), and within its holes.
template <int dim>
Lattice<dim> with_unequal_rows(const Lattice<dim>& lattice) {
  return {with_lines_at(lattice.grid(), {0.231, 0.2587, 0.283}), lattice.degree()};
}

/// Two holes with a wall of `wall` cells between them, and one that crosses the face of the sector; without
/// any symmetry.
template <int dim>
LevelSet<dim> thin_wall(const Lattice<dim>& lattice, double wall) {
  const double h = lattice.grid().resolution();
  return make_level_set<dim>(
      lattice, std::vector<Circle>{
                   {0.235, 0.13, 0.018}, {0.235 + 0.036 + wall * h, 0.14, 0.018}, {0.262, 0.42, 0.03}});
}

template <int dim>
std::vector<SurfacePoint<dim>> boundary_of(const LevelSet<dim>& psi) {
  const auto samples = boundary_samples<dim>(psi);
  return {samples.begin(), samples.end()};
}

struct ValueAndSteepness {
  double value, steepness;  ///< of a level set at a point of another one's boundary
};

template <int dim>
ValueAndSteepness at(const LevelSet<dim>& psi, const SurfacePoint<dim>& point) {
  const auto& grid = psi.lattice.grid();
  const ShapeFunctions<dim> shape(2, point.xi);
  const auto values = psi.cell_values(point.cell);
  double value = 0;
  Vec<dim> gradient{};
  for (std::size_t a = 0; a < values.size(); ++a) {
    value += shape.value[a] * values[a];
    for (int d = 0; d < dim; ++d) gradient[d] += shape.gradient[a][d] * values[a];
  }
  const CellMap<dim> map(grid, 2, grid.cell_position(point.cell));
  return {value, norm<dim>(transpose_times<dim>(inverse<dim>(map.jacobian(shape)), gradient))};
}

template <class Setting>
class BoundaryMotions : public ::testing::Test {};
TYPED_TEST_SUITE(BoundaryMotions, wheelwright::testing::DeformationSettings);

}  // namespace

/// Taylor's test with respect to the deformation: a point of the boundary that moves with its speed stays on
/// the boundary of the moved shape to second order, also where a wall is as thin as a cell and psi has a kink
/// in its middle.
TYPED_TEST(BoundaryMotions, PredictTheMovedShapeToSecondOrder) {
  constexpr int dim = TypeParam::dim;
  const Lattice<dim> equal = lattice_of<dim>(2);
  for (const auto& [wall, lattice] : {std::pair{4.0, equal},
                                      {2.0, equal},
                                      {1.5, equal},
                                      {1.0, equal},
                                      {2.0, with_unequal_rows<dim>(equal)}}) {
    const double h = lattice.grid().resolution();
    const DeformationSpace<dim> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                      TypeParam::kind);
    const auto deformation = wheelwright::testing::smooth_deformation<dim>(lattice, space.n_components());
    const auto psi = spline_level_set(spline_coefficients(thin_wall<dim>(lattice, wall)));
    const auto boundary = boundary_of<dim>(psi);
    const auto along_boundary = space.motion_of(psi, boundary).speeds(deformation);
    const auto speeds = space.speeds(psi, deformation);
    double last = 0;
    for (const double cells : {4e-3, 2e-3, 1e-3}) {
      const double time = cells * h / largest_magnitude(speeds);
      const auto moved = spline_level_set(smooth_transport<dim>(spline_coefficients(psi), speeds, time));
      double square = 0;
      for (std::size_t q = 0; q < boundary.size(); ++q) {
        const auto [before, steepness] = at<dim>(psi, boundary[q]);
        const double off = at<dim>(moved, boundary[q]).value - before + time * along_boundary[q] * steepness;
        square += boundary[q].weight * off * off;
      }
      const double remainder = std::sqrt(square);
      if (last > 0) {
        EXPECT_GT(std::log2(last / remainder), 1.9) << wall << " cells, " << cells;
      }
      last = remainder;
    }
  }
}

/// Also the load of a random density is the sum of density times speed, and what is held does not move.
TYPED_TEST(BoundaryMotions, LoadsAreTransposedSpeeds) {
  constexpr int dim = TypeParam::dim;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int degree : {1, 2}) {
    const auto lattice = lattice_of<dim>(degree);
    const auto psi = thin_wall<dim>(lattice, 2);
    const auto boundary = boundary_of<dim>(psi);
    std::vector<bool> held(lattice.n_nodes());
    for (std::size_t node = 0; node < held.size(); ++node) held[node] = node % 3 == 0;
    const BoundaryMotion<dim> free(psi, boundary, TypeParam::kind), motion = free.holding(held);
    const int n_components = TypeParam::kind == DeformationKind::vector_field ? dim : 1;
    std::vector<double> deformation(n_components * lattice.n_nodes()), density(boundary.size());
    for (double& x : deformation) x = normal(random);
    for (double& x : density) x = normal(random);
    const auto speeds = motion.speeds(deformation);
    double sum = 0;
    for (std::size_t q = 0; q < boundary.size(); ++q) sum += boundary[q].weight * density[q] * speeds[q];
    const auto load = motion.load(density);
    EXPECT_NEAR(std::inner_product(load.begin(), load.end(), deformation.begin(), 0.0), sum, 1e-10);
    auto stopped = deformation;
    for (std::size_t k = 0; k < stopped.size(); ++k)
      if (held[k % held.size()]) stopped[k] = 0;
    const auto of_free = free.speeds(stopped);
    for (std::size_t q = 0; q < boundary.size(); ++q) EXPECT_NEAR(of_free[q], speeds[q], 1e-12);
  }
}

/// Far from kinks the speed is the normal part of the deformation.
TYPED_TEST(BoundaryMotions, IsTheNormalPartOfTheDeformationAtSmoothEdges) {
  constexpr int dim = TypeParam::dim;
  const auto lattice = lattice_of<dim>(2, 2);
  const auto psi = make_level_set<dim>(lattice, std::vector<Circle>{{0.27, 0.26, 0.05}});
  const auto boundary = boundary_of<dim>(psi);
  const BoundaryMotion<dim> motion(psi, boundary, TypeParam::kind);
  const bool is_vector = TypeParam::kind == DeformationKind::vector_field;
  std::vector<double> deformation((is_vector ? dim : 1) * lattice.n_nodes());  // radially outwards, or 1
  for (int node = 0; node < lattice.n_nodes(); ++node) deformation[node] = 1;
  const auto speeds = motion.speeds(deformation);
  const auto size = lattice.grid().cell_size(0);
  const double tolerance = dim == 2 ? 3e-3 : 4e-2;
  for (std::size_t q = 0; q < boundary.size(); ++q) {
    const double azimuth = (lattice.grid().cell_position(boundary[q].cell)[1] + boundary[q].xi[1]) * size[1];
    const double radial =
        std::cos(azimuth) * boundary[q].normal[0] + std::sin(azimuth) * boundary[q].normal[1];
    EXPECT_NEAR(speeds[q], is_vector ? radial : 1, tolerance);
  }
}
