#pragma once

#include <numeric>
#include <stdexcept>

#include "tests/support.h"
#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/mechanics/elasticity/element.h"
#include "wheelwright/mechanics/state/material_rule.h"
#include "wheelwright/mechanics/state/ring_field.h"

/// A wheel by linear theory, and with large deformations where the second Piola-Kirchhoff stress is linear in
/// Green's strain: Newton's method on the whole ring, with a penalty for contact without friction. It shares
/// only the grid, the quadrature and the shape functions with the program's solver.
namespace wheelwright::testing {

enum class Theory { linear, large_deformation };

class PlaneWheel {
 public:
  /// The ground touches at azimuth 0. The rim only moves towards it.
  PlaneWheel(const RollingModel<2>& model, const LevelSet<2>& psi)
      : lattice_(model.grid, model.degree), law_(*model.materials.at_tread().isotropic()) {
    const auto domain = cut_domain(psi, model.degree + 2);
    if (!domain) throw std::runtime_error(domain.failure().detail);
    has_material_.assign(n_nodes(), false);
    const auto whole = unit_cell_rule<2>(model.degree + 1);
    MaterialRule<2>(*domain, model.degree + 2)
        .for_each_cell([&](int cell, std::span<const ReferencePoint<2>> points) {
          cells_.push_back({cell, {}});
          add_points(points, 1, false);
          if (domain->kinds[cell] == CellKind::cut) add_points(whole, filling, true);
          for (int sector = 0; sector < model.grid.n_sectors; ++sector)
            for (const std::size_t node : nodes(cell, sector)) has_material_[node] = true;
        });
    add_contact_points();
    number_unknowns();
  }

  /// The force of the ground at a travel of the rim [N/m].
  double force(Theory theory, double travel) const {
    std::vector<double> u = rim_motion(travel);
    solve(Theory::linear, u);
    if (theory == Theory::large_deformation) solve(theory, u);
    const Derivatives d = derivatives(theory, u);
    const std::vector<double> unit = rim_motion(1);
    return std::inner_product(unit.begin(), unit.end(), d.residual.begin(), 0.0);
  }

 private:
  static constexpr double filling =
      1e-4;  ///< stiffness of the empty part of cut cells, by that of the material
  static constexpr int n_dofs = 18;
  using Gradient = std::array<std::array<double, ElasticElement<2>::max_dofs>, 4>;

  /// A quadrature point: the map from the polar components at the nodes of its cell to the displacement
  /// gradient in the frame of the cell.
  struct Point {
    Gradient gradient;
    double weight;
    bool is_filling;  ///< always linear
  };

  /// A cell in every sector.
  struct Cell {
    int cell;
    std::vector<Point> points;
  };

  /// A point of the tread near the ground.
  struct ContactPoint {
    RingCellNodes<2> nodes;
    std::array<double, n_dofs> towards_ground;  ///< map from the polar components
    double height;                              ///< along the normal of the ground, undeformed
    double weight;
  };

  /// Derivatives of the energy: those of a cell, and those of the wheel.
  struct CellDerivatives {
    std::array<double, n_dofs> residual{};
    std::array<std::array<double, n_dofs>, n_dofs> tangent{};
  };
  struct Derivatives {
    std::vector<double> residual;  ///< of all polar components at nodes
    std::vector<SparseSpd::Entry> tangent;
  };

  int n_nodes() const { return lattice_.n_nodes() * lattice_.grid().n_sectors; }

  RingCellNodes<2> nodes(int cell, int sector) const {
    const auto place = lattice_.grid().cell_position(cell);
    return ring_cell_nodes<2>(lattice_, {place[0], place[1] + sector * lattice_.grid().columns()});
  }

  double node_azimuth(std::size_t node) const {
    const std::size_t of_sector = lattice_.n_nodes();
    return lattice_.polar_point(static_cast<int>(node % of_sector))[1] +
           static_cast<double>(node / of_sector) * lattice_.grid().sector_angle();
  }

  /// To the last cell.
  void add_points(std::span<const ReferencePoint<2>> points, double factor, bool is_filling) {
    const PolarGrid<2>& grid = lattice_.grid();
    Cell& last = cells_.back();
    const ElasticElement<2> element(grid, lattice_.degree(), grid.cell_position(last.cell), law_);
    const auto quadrature = weighted_points(grid, lattice_.degree(), last.cell, points);
    for (std::size_t q = 0; q < points.size(); ++q)
      last.points.push_back({element.gradient(points[q].xi), factor * quadrature.weights[q], is_filling});
  }

  void add_contact_points() {
    const PolarGrid<2>& grid = lattice_.grid();
    const int last = grid.cells[0] - 1, near = grid.ring_columns() / 8;
    const CellMap<2> map(grid, lattice_.degree(), {last, 0});
    for (int column = -near; column < near; ++column)
      for (const auto& q : unit_cell_rule<1>(3)) {
        const ShapeFunctions<2> shape(lattice_.degree(), {1, q.xi[0]});
        const int of_ring = wrap(column, grid.ring_columns());
        ContactPoint point{ring_cell_nodes<2>(lattice_, {last, of_ring}), {}, 0, 0};
        const Vec<2> x = rotated<2>(map.position(shape), column * grid.column_angle());
        for (int a = 0; a < 9; ++a) {
          const double azimuth = node_azimuth(point.nodes[a]);
          point.towards_ground[2 * a] = shape.value[a] * std::cos(azimuth);
          point.towards_ground[2 * a + 1] = -shape.value[a] * std::sin(azimuth);
        }
        point.height = x[0];
        point.weight = q.weight * grid.outer_radius * grid.column_angle();
        contact_points_.push_back(point);
      }
  }

  /// All but those of the rim and of nodes without material.
  void number_unknowns() {
    numbers_.assign(2 * n_nodes(), -1);
    for (int node = 0; node < n_nodes(); ++node)
      if (lattice_.node_position(node % lattice_.n_nodes())[0] > 0 && has_material_[node])
        for (int c = 0; c < 2; ++c) numbers_[2 * node + c] = n_unknowns_++;
  }

  /// Polar components of the rim's nodes, zero elsewhere.
  std::vector<double> rim_motion(double travel) const {
    std::vector<double> u(2 * n_nodes(), 0.0);
    for (int node = 0; node < n_nodes(); ++node)
      if (lattice_.node_position(node % lattice_.n_nodes())[0] == 0) {
        u[2 * node] = travel * std::cos(node_azimuth(node));
        u[2 * node + 1] = -travel * std::sin(node_azimuth(node));
      }
    return u;
  }

  std::array<double, n_dofs> at_nodes(const std::vector<double>& u, const RingCellNodes<2>& nodes) const {
    std::array<double, n_dofs> values;
    for (int a = 0; a < 9; ++a)
      for (int c = 0; c < 2; ++c) values[2 * a + c] = u[2 * nodes[a] + c];
    return values;
  }

  void add(const RingCellNodes<2>& nodes, const CellDerivatives& of_cell, Derivatives& sum) const {
    for (int i = 0; i < n_dofs; ++i) {
      const std::size_t of_i = 2 * nodes[i / 2] + i % 2;
      sum.residual[of_i] += of_cell.residual[i];
      for (int j = 0; j < n_dofs; ++j) {
        const int row = numbers_[of_i], column = numbers_[2 * nodes[j / 2] + j % 2];
        if (column >= 0 && row >= column) sum.tangent.push_back({row, column, of_cell.tangent[i][j]});
      }
    }
  }

  void add_material(const Point& point, Theory theory, const std::array<double, n_dofs>& u,
                    CellDerivatives& sum) const {
    const bool is_large = theory == Theory::large_deformation && !point.is_filling;
    Mat<2> g{}, f{{{1, 0}, {0, 1}}};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < n_dofs; ++i) g[k / 2][k % 2] += point.gradient[k][i] * u[i];
    Voigt<2> strain{g[0][0], g[1][1], g[0][1] + g[1][0]};
    for (int c = 0; is_large && c < 2; ++c) {
      f[c] += g[c];
      strain += Voigt<2>{0.5 * g[c][0] * g[c][0], 0.5 * g[c][1] * g[c][1], g[c][0] * g[c][1]};
    }
    const Voigt<2> s = stress<2>(law_, strain);
    std::array<Voigt<2>, n_dofs> slope, stress_slope;
    for (int i = 0; i < n_dofs; ++i) {
      const auto d = [&](int row, int column) { return point.gradient[2 * row + column][i]; };
      slope[i] = {f[0][0] * d(0, 0) + f[1][0] * d(1, 0), f[0][1] * d(0, 1) + f[1][1] * d(1, 1),
                  f[0][0] * d(0, 1) + f[1][0] * d(1, 1) + f[0][1] * d(0, 0) + f[1][1] * d(1, 0)};
      stress_slope[i] = stress<2>(law_, slope[i]);
      sum.residual[i] += point.weight * dot(s, slope[i]);
    }
    for (int i = 0; i < n_dofs; ++i)
      for (int j = 0; j < n_dofs; ++j) {
        double value = dot(slope[i], stress_slope[j]);
        for (int c = 0; is_large && c < 2; ++c) {
          const auto &x = point.gradient[2 * c], &y = point.gradient[2 * c + 1];
          value += s[0] * x[i] * x[j] + s[1] * y[i] * y[j] + s[2] * (x[i] * y[j] + y[i] * x[j]);
        }
        sum.tangent[i][j] += point.weight * value;
      }
  }

  void add_contact(const ContactPoint& point, const std::vector<double>& u, Derivatives& sum) const {
    const auto& slope = point.towards_ground;
    const double overlap = point.height + dot(slope, at_nodes(u, point.nodes)) - lattice_.grid().outer_radius;
    if (overlap <= 0) return;
    const double penalty = point.weight * 20 * law_.scaling_modulus() / lattice_.grid().resolution();
    CellDerivatives of_point{penalty * overlap * slope, {}};
    for (int i = 0; i < n_dofs; ++i) of_point.tangent[i] = penalty * slope[i] * slope;
    add(point.nodes, of_point, sum);
  }

  Derivatives derivatives(Theory theory, const std::vector<double>& u) const {
    Derivatives sum{std::vector<double>(u.size(), 0.0), {}};
    for (int sector = 0; sector < lattice_.grid().n_sectors; ++sector)
      for (const Cell& cell : cells_) {
        const auto of_cell = nodes(cell.cell, sector);
        const auto values = at_nodes(u, of_cell);
        CellDerivatives cell_sum;
        for (const Point& point : cell.points) add_material(point, theory, values, cell_sum);
        add(of_cell, cell_sum, sum);
      }
    for (const ContactPoint& point : contact_points_) add_contact(point, u, sum);
    return sum;
  }

  std::vector<double> of_unknowns(const std::vector<double>& all) const {
    std::vector<double> result(n_unknowns_);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (numbers_[i] >= 0) result[numbers_[i]] = all[i];
    return result;
  }

  /// Newton's method from a displacement with the motion of the rim.
  void solve(Theory theory, std::vector<double>& u) const {
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Derivatives d = derivatives(theory, u);
      const auto factor = SparseSpd::factor(n_unknowns_, d.tangent);
      if (!factor) throw std::runtime_error("the structure has lost its stability");
      const std::vector<double> step = factor->solve(of_unknowns(d.residual));
      double largest = 0;
      for (std::size_t i = 0; i < u.size(); ++i)
        if (numbers_[i] >= 0) {
          u[i] -= step[numbers_[i]];
          largest = std::max(largest, std::abs(step[numbers_[i]]));
        }
      if (largest < 1e-11 * lattice_.grid().outer_radius) return;
    }
    throw std::runtime_error("Newton's method does not converge");
  }

  Lattice<2> lattice_;
  IsotropicLaw<2> law_;
  std::vector<bool> has_material_;
  std::vector<Cell> cells_;
  std::vector<ContactPoint> contact_points_;
  std::vector<int> numbers_;  ///< of the unknowns among the polar components at nodes; -1: given
  int n_unknowns_ = 0;
};

}  // namespace wheelwright::testing
