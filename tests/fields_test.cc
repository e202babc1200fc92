#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/mechanics/rolling/ring_displacement.h"
#include "wheelwright/mechanics/rolling/ring_state.h"
#include "wheelwright/output/report/cell_means.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/tread_contact.h"

namespace wheelwright {
namespace {

using testing::holes;

/// A wheel without any symmetry: its holes differ, one lies across a sector face, and all loads act on it.
RollingModel<2> asymmetric_model(int degree) {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, 0.12, 7, {9, 15}};
  model.degree = degree;
  model.materials = Material{60e6, 0.4};
  model.contact.friction = 0.5;
  model.load = 20e3;
  model.horizontal_force = 500;
  model.torque = 780;
  model.distributed = {{2e4, 1e4}, 0};
  model.n_positions = 3;
  return model;
}

LevelSet<2> asymmetric_shape(const PolarGrid<2>& grid) {
  return holes(grid, 2, {{0.262, 0.05, 0.022}, {0.281, 0.43, 0.024}, {0.246, 0.62, 0.017}});
}

struct Solved {
  RollingProblem<2> problem;
  RollingSolution<2> solution;
};

Solved solved(int degree) {
  const auto model = asymmetric_model(degree);
  auto problem = RollingProblem<2>::create(model);
  auto solution = problem->solve(asymmetric_shape(model.grid));
  EXPECT_TRUE(solution) << solution.failure().detail;
  return {*std::move(problem), *std::move(solution)};
}

/// The nodes of the full ring: calls visit(index in a field's nodes, radius, azimuth).
template <class Visit>
void for_each_node(const RollingProblem<2>& problem, Visit visit) {
  const Lattice<2> lattice(problem.model().grid, problem.model().degree);
  for (int sector = 0; sector < lattice.grid().n_sectors; ++sector)
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const Vec<2> p = lattice.polar_point(node);
      visit(std::size_t(node) + std::size_t(lattice.n_nodes()) * sector, p[0],
            p[1] + sector * lattice.grid().sector_angle());
    }
}

template <class F>
RingField displacement_of(const RollingProblem<2>& problem, F u) {
  RingField field{2, {}};
  for_each_node(problem, [&](std::size_t, double radius, double azimuth) {
    for (const double value : u(cartesian<2>({radius, azimuth}))) field.values.push_back(value);
  });
  return field;
}

/// sqrt(3/2 s:s) in plane strain, from the displacement's gradient.
double von_mises_of(const Material& material, const Mat<2>& gradient) {
  const double xx = gradient[0][0], yy = gradient[1][1], xy = 0.5 * (gradient[0][1] + gradient[1][0]);
  const double trace = xx + yy, mean = trace / 3;
  const double square = (xx - mean) * (xx - mean) + (yy - mean) * (yy - mean) + mean * mean + 2 * xy * xy;
  return 2 * material.mu() * std::sqrt(1.5 * square);
}

/// The stress in plane strain from the displacement's gradient: xx, yy, zz, xy.
std::array<double, 4> stress_of(const Material& material, const Mat<2>& gradient) {
  const double xx = gradient[0][0], yy = gradient[1][1], xy = 0.5 * (gradient[0][1] + gradient[1][0]);
  const double mean = material.lambda() * (xx + yy), two_mu = 2 * material.mu();
  return {mean + two_mu * xx, mean + two_mu * yy, mean, two_mu * xy};
}

/// The von Mises stress at every node.
std::vector<double> von_mises_at_nodes(const RingField& stress) {
  const NamedField von_mises = von_mises_field(stress);
  std::vector<double> result;
  for (std::size_t k = 0; k < stress.values.size(); k += 4)
    result.push_back(von_mises.scalar(std::span(&stress.values[k], 4)));
  return result;
}

// The elements are isoparametric: they hold displacements that are linear in x and y, and their rotations.
TEST(StressField, IsExactForLinearDisplacements) {
  for (const int degree : {1, 2}) {
    const auto [problem, solution] = solved(degree);
    for (const Mat<2>& a : {Mat<2>{{{2e-3, -7e-3}, {1.5e-3, 4e-3}}}, Mat<2>{{{-1e-3, 5e-3}, {5e-3, 1e-3}}}}) {
      const RingField u = displacement_of(problem, [&](const Vec<2>& x) {
        return Vec<2>{1e-3 + a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1] - 2e-3};
      });
      const RingField stress = stress_field(problem.model(), solution.domain, u);
      const Material& material = *problem.model().materials.at_tread().isotropic();
      const auto expected = stress_of(material, a);
      const double von_mises = von_mises_of(material, a);
      std::size_t n = 0;
      for (std::size_t k = 0; k < stress.values.size(); ++k) {
        if (std::isnan(stress.values[k])) continue;
        EXPECT_NEAR(stress.values[k], expected[k % 4], 1e-9 * von_mises) << k % 4;
        ++n;
      }
      EXPECT_GT(n, 0.8 * stress.values.size());
      for (const double value : von_mises_at_nodes(stress))
        EXPECT_FALSE(std::abs(value - von_mises) > 1e-9 * von_mises);
    }
  }
}

TEST(StressField, RotationsHaveNoStress) {
  for (const int degree : {1, 2}) {
    const auto [problem, solution] = solved(degree);
    const double rotation = 1e-2;
    const RingField u = displacement_of(problem, [&](const Vec<2>& x) {
      return Vec<2>{-rotation * x[1], rotation * x[0]};
    });
    for (const double value : von_mises_at_nodes(stress_field(problem.model(), solution.domain, u)))
      EXPECT_FALSE(value >
                   1e-9 * rotation * problem.model().materials.at_tread().isotropic()->youngs_modulus);
  }
}

// u = (x y, x^2 - 3 y^2) k has a stress that differs from point to point, and from a point to its mirror
// image.
TEST(StressField, FollowsTheVaryingStress) {
  const auto [problem, solution] = solved(2);
  const double k = 0.02;
  const RingField u = displacement_of(problem, [&](const Vec<2>& x) {
    return Vec<2>{k * x[0] * x[1], k * (x[0] * x[0] - 3 * x[1] * x[1] + x[0] * x[1])};
  });
  const Material& material = *problem.model().materials.at_tread().isotropic();
  const RingField stress = stress_field(problem.model(), solution.domain, u);
  const std::vector<double> von_mises = von_mises_at_nodes(stress);
  const double tolerance = 2e-2 * k * material.youngs_modulus * 0.3;
  for_each_node(problem, [&](std::size_t node, double radius, double azimuth) {
    if (std::isnan(von_mises[node])) return;
    const Vec<2> x = cartesian<2>({radius, azimuth});
    const Mat<2> gradient{{{k * x[1], k * x[0]}, {k * (2 * x[0] + x[1]), k * (-6 * x[1] + x[0])}}};
    EXPECT_NEAR(von_mises[node], von_mises_of(material, gradient), tolerance) << radius << ' ' << azimuth;
    const auto expected = stress_of(material, gradient);
    for (int c = 0; c < 4; ++c)
      EXPECT_NEAR(stress.values[4 * node + c], expected[c], 3 * tolerance) << radius << ' ' << azimuth;
  });
}

// The rim moves rigidly: towards the ground and along it, and it turns, each in the body frame.
TEST(DisplacementField, TheRimMovesRigidly) {
  for (const int degree : {1, 2}) {
    const auto [problem, solution] = solved(degree);
    for (int position = 0; position < solution.positions.size(); ++position) {
      const RingField u = RingDisplacement<2>(problem, solution).at_nodes(position);
      const double ground = 2 * std::numbers::pi / 7 * position / 3;
      const RimMotion& rim = solution.states[position].rim;
      EXPECT_GT(rim.towards_ground, 0);
      for_each_node(problem, [&](std::size_t node, double radius, double azimuth) {
        if (radius > problem.model().grid.inner_radius + 1e-9) return;
        const Vec<2> x = cartesian<2>({radius, azimuth});
        const double c = std::cos(ground), s = std::sin(ground);
        EXPECT_NEAR(u.values[2 * node], c * rim.towards_ground - s * rim.along_ground - rim.rotation * x[1],
                    1e-14);
        EXPECT_NEAR(u.values[2 * node + 1],
                    s * rim.towards_ground + c * rim.along_ground + rim.rotation * x[0], 1e-14);
      });
    }
  }
}

/// The deformed place of the tread at an azimuth of the body frame, on the outermost line of nodes.
Vec<2> deformed_tread(const RollingProblem<2>& problem, const RingField& u, double azimuth) {
  const Lattice<2> lattice(problem.model().grid, problem.model().degree);
  const PolarGrid<2>& grid = lattice.grid();
  const int n = grid.ring_columns();
  const double column = azimuth / (2 * std::numbers::pi) * n;
  const int first = static_cast<int>(std::floor(column));
  const double eta = column - first;
  const auto at = [&](int node, int component) {
    const int wrapped = (2 * first + node + 2 * n) % (2 * n), per_sector = lattice.nodes()[1];
    const std::size_t index = lattice.node_index({lattice.nodes()[0] - 1, wrapped % per_sector}) +
                              std::size_t(lattice.n_nodes()) * (wrapped / per_sector);
    return u.values[2 * index + component];
  };
  Vec<2> x = cartesian<2>({grid.outer_radius, azimuth});
  for (int d = 0; d < 2; ++d)
    x[d] += (1 - eta) * (1 - 2 * eta) * at(0, d) + 4 * eta * (1 - eta) * at(1, d) +
            eta * (2 * eta - 1) * at(2, d);
  return x;
}

// The ground is the plane at the tread's radius below the axle: a point's gap is its distance to that plane.
TEST(ContactPoints, GapsAreThoseOfTheDisplacementAtTheirAzimuth) {
  const auto [problem, solution] = solved(2);
  const double radius = problem.model().grid.outer_radius;
  const auto points = contact_points(problem, *ring_state<2>(problem, solution));
  int touching = 0, last = -1;
  RingField u;
  for (const ContactPoint& point : points) {
    if (point.position != last) u = RingDisplacement<2>(problem, solution).at_nodes(last = point.position);
    const double ground = 2 * std::numbers::pi / 7 * point.position / 3;
    const Vec<2> x = deformed_tread(problem, u, ground + point.azimuth);
    const double travel = solution.states[point.position].rim.towards_ground;
    EXPECT_NEAR(point.gap, radius - x[0] * std::cos(ground) - x[1] * std::sin(ground), 2e-4 * travel);
    EXPECT_NEAR(point.x, radius * std::sin(point.azimuth), 1e-5 * radius);
    touching += point.pressure > 0;
    EXPECT_GE(point.pressure, 0);
  }
  EXPECT_GT(touching, 10);
}

// Every cell at the tread has the points of the Gauss rule, halved cells as well as whole ones, in its own
// range of azimuths. Their means carry the forces and their moments, without the jumps of points inside a
// cell.
TEST(ContactPoints, TheirMeansOverCellsCarryTheSameForces) {
  for (const int levels : {0, 2}) {
    auto model = asymmetric_model(2);
    model.tread.levels = levels;
    const auto problem = RollingProblem<2>::create(model);
    const auto solution = problem->solve(asymmetric_shape(model.grid));
    ASSERT_TRUE(solution);
    const auto points = contact_points(*problem, *ring_state<2>(*problem, *solution));
    const auto cells = cell_means(points);
    const int n_cells = model.grid.ring_columns() << levels;
    const double width = 2 * std::numbers::pi / n_cells;
    std::map<std::pair<int, int>, int> counts;
    for (const ContactPoint& p : points) {
      const double azimuth = 2 * std::numbers::pi / 7 * p.position / 3 + p.azimuth;
      EXPECT_EQ(p.cell, (static_cast<int>(std::floor(azimuth / width)) + n_cells) % n_cells);
      ++counts[{p.position, p.cell}];
    }
    EXPECT_EQ(counts.size(), cells.size());
    for (const auto& [place, count] : counts) EXPECT_EQ(count, model.contact_points);
    for (const auto& moment :
         {+[](const ContactPoint& p) { return p.pressure; },
          +[](const ContactPoint& p) { return p.friction; }, +[](const ContactPoint& p) { return p.x; }}) {
      std::array<double, 3> of_points{}, of_cells{};
      for (const ContactPoint& p : points) of_points[p.position] += p.weight * moment(p);
      for (const ContactPoint& p : cells) of_cells[p.position] += p.weight * moment(p);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(of_cells[i], of_points[i], 1e-9 * std::abs(of_points[i]) + 1e-12);
    }
    for (std::size_t k = 1; k < cells.size(); ++k) {
      if (cells[k].position == cells[k - 1].position) {
        EXPECT_GT(cells[k].x, cells[k - 1].x);
      }
    }
  }
}

// The whole tread at once: what it shows at the contact points is what contact_points() shows.
TEST(TreadContact, IsThatOfTheContactPointsAndFreeElsewhere) {
  const auto [problem, solution] = solved(2);
  const auto state = ring_state<2>(problem, solution);
  const auto treads = all_tread_contacts(problem, *state);
  const auto points = contact_points(problem, *state);
  ASSERT_EQ(treads.size(), 3u);
  for (int position = 0; position < 3; ++position) {
    const double ground = 2 * std::numbers::pi / 7 * position / 3;
    double length = 0, force = 0, expected_force = 0;
    std::size_t found = 0;
    for (const TreadContactPoint<2>& p : treads[position]) {
      length += p.weight;
      force += p.weight * p.pressure;
      const Vec<2> in_ground_frame = rotated<2>(p.traction, -ground);
      EXPECT_NEAR(in_ground_frame[0], -p.pressure, 1e-9 * p.pressure);
      EXPECT_NEAR(in_ground_frame[1], p.friction, 1e-9 * p.pressure);
      const Vec<2> x = rotated<2>(p.position, -ground), u = rotated<2>(p.displacement, -ground);
      EXPECT_NEAR(p.gap, problem.model().grid.outer_radius - x[0] - u[0], 1e-15);
      for (const ContactPoint& q : points) {
        if (q.position != position || std::abs(q.x - x[1]) > 1e-9 || x[0] < 0) continue;
        ++found;
        EXPECT_EQ(p.pressure, q.pressure);
        EXPECT_EQ(p.friction, q.friction);
        EXPECT_EQ(p.weight, q.weight);
        EXPECT_NEAR(p.gap, q.gap, 1e-12);
      }
    }
    std::size_t in_position = 0;
    for (const ContactPoint& q : points)
      if (q.position == position) {
        ++in_position;
        expected_force += q.weight * q.pressure;
      }
    EXPECT_EQ(found, in_position);
    EXPECT_NEAR(force, expected_force, 1e-12 * force);
    EXPECT_NEAR(length, 2 * std::numbers::pi * problem.model().grid.outer_radius, 1e-6);
    // By azimuth, all the way round.
    double turn = 0;
    for (std::size_t k = 0; k < treads[position].size(); ++k) {
      const Vec<2>&a = treads[position][k].position,
            &b = treads[position][(k + 1) % treads[position].size()].position;
      const double step = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
      EXPECT_GT(step, 0);
      turn += step;
    }
    EXPECT_NEAR(turn, 2 * std::numbers::pi, 1e-9);
  }
}

// With y up and the ground below, x and the azimuth grow the same way as the forces. Moments about the axle:
// P x_p = R H' - M, where H' is all that friction holds and the body force acts on every cubic metre alike.
TEST(ContactPoints, ThePressureStandsWhereForceAndTorqueDriveIt) {
  const auto [problem, solution] = solved(2);
  const RollingModel<2>& model = problem.model();
  double material = 0;
  for (const double weight : {1.0, -1.0})
    for (const double area : weight > 0
                                 ? std::vector{0.34 * 0.34 - 0.2 * 0.2}
                                 : std::vector{7 * 0.022 * 0.022, 7 * 0.024 * 0.024, 7 * 0.017 * 0.017})
      material += weight * std::numbers::pi * area;
  const double down = model.load + model.distributed.body_force[0] * material;
  const double along = model.horizontal_force + model.distributed.body_force[1] * material;
  for (int i = 0; i < solution.positions.size(); ++i) {
    double force = 0, moment = 0;
    const auto& contact = solution.contacts[i];
    for (int q = 0; q < contact.n_points(); ++q) {
      const double weight = contact.points()[q].weight;
      force -= weight * solution.states[i].traction[q][0];
      moment -= weight * solution.states[i].traction[q][0] * contact.points()[q].position[1];
    }
    EXPECT_NEAR(force, down, 1e-4 * down);
    EXPECT_NEAR(moment / force, (model.grid.outer_radius * along - model.torque) / down, 3e-5) << i;
  }
}

TEST(RepeatedField, HasTheLevelSetsValuesInEverySector) {
  const auto [problem, solution] = solved(2);
  const auto psi = asymmetric_shape(problem.model().grid);
  const RingField field = repeated_field(problem.model(), psi);
  for (std::size_t k = 0; k < field.values.size(); ++k)
    EXPECT_NEAR(field.values[k], psi.values[k % psi.values.size()], 1e-15);
}

}  // namespace
}  // namespace wheelwright
