#include <gtest/gtest.h>

#include "tests/support.h"
#include "wheelwright/mechanics/rolling/ring_displacement.h"

namespace wheelwright {
namespace {

/// A solid ring pressed so hard that the contact is about 12 cm wide, on a uniform grid of about square
/// cells.
struct Pressed {
  std::unique_ptr<RollingProblem<2>> problem;
  RingField displacement;
};

Pressed press(int degree, int angular_cells, double theta, double gamma_0) {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 48, {angular_cells / 12, angular_cells / 48}};
  model.degree = degree;
  model.materials = Material{200e6, 0.3};
  model.contact.theta_nitsche = theta;
  model.contact.gamma_0 = gamma_0;
  model.load = 2e6;
  model.n_positions = 1;
  auto created = RollingProblem<2>::create(model);
  EXPECT_TRUE(created);
  auto problem = std::make_unique<RollingProblem<2>>(*std::move(created));
  LevelSet<2> solid{Lattice<2>(model.grid, 1), {}};
  solid.values.assign(solid.lattice.n_nodes(), -1.0);
  const auto solution = problem->solve(solid);
  EXPECT_TRUE(solution) << solution.failure().detail;
  RingField field = RingDisplacement<2>(*problem, *solution).at_nodes(0);
  return {std::move(problem), std::move(field)};
}

/// Node of the full ring: position[1] counts round the ring.
size_t ring_node(const Lattice<2>& lattice, std::array<int, 2> p) {
  const int per_sector = lattice.nodes()[1], round = per_sector * lattice.grid().n_sectors;
  p[1] %= round;
  return lattice.node_index({p[0], p[1] % per_sector}) + size_t(lattice.n_nodes()) * (p[1] / per_sector);
}

Vec<2> nodal(const Lattice<2>& lattice, const RingField& field, const std::array<int, 2>& p) {
  const size_t node = ring_node(lattice, p);
  return {field.values[2 * node], field.values[2 * node + 1]};
}

/// sqrt(a(e, e)) of the difference between a coarse solution and the reference, on the reference's grid.
double energy_error(const Pressed& coarse, const Pressed& reference) {
  const PolarGrid<2>&grid = reference.problem->model().grid, &coarse_grid = coarse.problem->model().grid;
  const Lattice<2> lattice(grid, reference.problem->model().degree);
  const Lattice<2> coarse_lattice(coarse_grid, coarse.problem->model().degree);
  const int degree = lattice.degree(), coarse_degree = coarse_lattice.degree();
  const int ratio = degree * grid.cells[0] / coarse_grid.cells[0];  // fine node spacings in a coarse cell
  const auto difference = [&](const std::array<int, 2>& p) {
    const std::array<int, 2> cell{std::min(p[0] / ratio, coarse_grid.cells[0] - 1), p[1] / ratio};
    const ShapeFunctions<2> shape(coarse_degree,
                                  {double(p[0]) / ratio - cell[0], double(p[1]) / ratio - cell[1]});
    Vec<2> e = nodal(lattice, reference.displacement, p);
    for (int a = 0; a < nodes_per_cell<2>(coarse_degree); ++a) {
      auto q = local_node_position<2>(coarse_degree, a);
      for (int d = 0; d < 2; ++d) q[d] += coarse_degree * cell[d];
      const Vec<2> u = nodal(coarse_lattice, coarse.displacement, q);
      for (int d = 0; d < 2; ++d) e[d] -= shape.value[a] * u[d];
    }
    return e;
  };
  double energy = 0;
  for (int column = 0; column < grid.ring_columns(); ++column) {
    for (int row = 0; row < grid.cells[0]; ++row) {
      std::vector<double> e;
      for (int a = 0; a < nodes_per_cell<2>(degree); ++a) {
        auto p = local_node_position<2>(degree, a);
        p[0] += degree * row;
        p[1] += degree * column;
        const double azimuth = p[1] * lattice.node_angle();
        const Vec<2> polar = rotated<2>(difference(p), -azimuth);
        e.insert(e.end(), polar.begin(), polar.end());
      }
      const Matrix& k = reference.problem->elements().full_cell_stiffness(row);
      for (size_t j = 0; j < e.size(); ++j)
        for (size_t i = 0; i < e.size(); ++i) energy += e[i] * k(int(i), int(j)) * e[j];
    }
  }
  return std::sqrt(energy);
}

// Chouly, Hild, Renard 2015; Fabre, Pousin, Renard 2016: order 1 for degree 1, 3/2 for degree 2, for every
// theta. Measured: 0.97 to 0.99 and 1.49.
TEST(NitscheRates, AreOptimalForEveryTheta) {
  const Pressed reference = press(2, 1536, -1, 1);
  for (const auto& [theta, gamma_0] : {std::pair{-1.0, 1.0}, {0.0, 10.0}, {1.0, 100.0}}) {
    for (int degree : {1, 2}) {
      std::vector<double> errors;
      for (int cells : {96, 192, 384})
        errors.push_back(energy_error(press(degree, cells, theta, gamma_0), reference));
      const double order = 0.5 * std::log2(errors.front() / errors.back());
      EXPECT_GT(order, degree == 1 ? 0.85 : 1.35) << "theta " << theta << ", degree " << degree;
    }
  }
}

}  // namespace
}  // namespace wheelwright
