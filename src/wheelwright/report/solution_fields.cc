#include "wheelwright/report/solution_fields.h"

#include <cmath>
#include <limits>

namespace wheelwright {
namespace {

constexpr double no_material = std::numeric_limits<double>::quiet_NaN();

Lattice<2> displacement_lattice(const RollingProblem<2>& problem) {
  return Lattice<2>(problem.model().grid, problem.model().degree);
}

}  // namespace

RingField displacement_field(const RollingProblem<2>& problem, const RollingSolution<2>& s, int position) {
  const Lattice<2> lattice = displacement_lattice(problem);
  const PolarGrid<2>& grid = lattice.grid();
  const SectorSpace<2>& space = s.ring.sector().space;
  const int n_sectors = grid.n_sectors, n_columns = grid.ring_columns(), degree = lattice.degree();
  const int base_row = degree * problem.core_rows();

  Matrix outer(s.outer_line.rows(), n_sectors), loads(s.tread_loads.rows(), n_columns);
  std::copy_n(s.outer_line.column(position * n_sectors), outer.entries().size(), outer.data());
  std::copy_n(s.tread_loads.column(position * n_columns), loads.entries().size(), loads.data());
  const TreadLoads on_tread = tread_loads(problem.tread(), loads);
  const Matrix tread =
      nodal_displacements(problem.tread(), tread_field(problem.tread(), outer, on_tread), on_tread);
  const int upper_rows = degree * problem.tread().rows();

  const SectorFields core = complete_displacement(s);
  const double ground_azimuth = s.positions.grounds[position].azimuth(grid);
  RingField field{2, std::vector<double>(2 * size_t(lattice.n_nodes()) * n_sectors, no_material)};
  for (int sector = 0; sector < n_sectors; ++sector) {
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const auto p = lattice.node_position(node);
      Vec<2> polar{};
      if (p[0] > base_row) {
        const int column = sector * grid.columns() + p[1] / degree;
        const int row = 2 * ((p[1] % degree) * upper_rows + p[0] - base_row - 1);
        polar = {tread(row, column), tread(row + 1, column)};
      } else if (p[0] > 0) {
        // Nodes of the first azimuth may belong to the sector before alone.
        int number = space.number(p), from = sector;
        if (number < 0 && p[1] == 0) {
          number = space.number({p[0], lattice.nodes()[1]});
          from = (sector + n_sectors - 1) % n_sectors;
        }
        if (number < 0) continue;
        const int load_case = position * n_sectors + from;
        polar = {core.value(load_case, s.ring.row(2 * number)),
                 core.value(load_case, s.ring.row(2 * number + 1))};
      }
      const Vec<2> at = lattice.polar_point(p);
      const double azimuth = at[1] + sector * grid.sector_angle();
      const Vec<2> u = rotated<2>(polar, azimuth);
      const Vec<2> of_rim =
          rotated<2>(displacement<2>(s.states[position].rim, cartesian<2>({at[0], azimuth - ground_azimuth})),
                     ground_azimuth);
      double* value = &field.values[2 * (node + size_t(lattice.n_nodes()) * sector)];
      for (int d = 0; d < 2; ++d) value[d] = u[d] + of_rim[d];
    }
  }
  return field;
}

RingField vertical_field(const RingField& displacement, double ground_azimuth) {
  const double x = std::cos(ground_azimuth), y = std::sin(ground_azimuth);
  RingField field{1, {}};
  for (size_t i = 0; i < displacement.values.size(); i += 2)
    field.values.push_back(x * displacement.values[i] + y * displacement.values[i + 1]);
  return field;
}

RingField von_mises_field(const RollingProblem<2>& problem, const RollingSolution<2>& s,
                          const RingField& displacement) {
  const Lattice<2> lattice = displacement_lattice(problem);
  const PolarGrid<2>& grid = lattice.grid();
  const int n_sectors = grid.n_sectors, degree = lattice.degree(), n_nodes = lattice.n_nodes();
  std::vector<double> sum(size_t(n_nodes) * n_sectors, 0.0);
  std::vector<int> count(sum.size(), 0);
  for (int radial = 0; radial < grid.cells[0]; ++radial) {
    const auto& element = problem.elements().element(radial);
    std::vector<ElasticElement<2>::Point> points;
    for (int a = 0; a < element.n_nodes(); ++a) {
      const auto p = local_node_position<2>(degree, a);
      points.push_back(element.at({double(p[0]) / degree, double(p[1]) / degree}));
    }
    for (int column = 0; column < grid.columns(); ++column) {
      if (!s.domain.active(grid.cell_index({radial, column}))) continue;
      for (int sector = 0; sector < n_sectors; ++sector) {
        std::array<size_t, 9> nodes;
        std::array<double, ElasticElement<2>::max_dofs> u;
        for (int a = 0; a < element.n_nodes(); ++a) {
          auto p = local_node_position<2>(degree, a);
          p[0] += degree * radial;
          p[1] += degree * column;
          const int node_sector = (sector + p[1] / lattice.nodes()[1]) % n_sectors;
          nodes[a] = lattice.node_index(p) + size_t(n_nodes) * node_sector;
          const double azimuth = lattice.polar_point(p)[1] + sector * grid.sector_angle();
          const Vec<2> polar = rotated<2>(
              {displacement.values[2 * nodes[a]], displacement.values[2 * nodes[a] + 1]}, -azimuth);
          u[2 * a] = polar[0];
          u[2 * a + 1] = polar[1];
        }
        for (int a = 0; a < element.n_nodes(); ++a) {
          Voigt<2> strain{};
          for (int k = 0; k < n_strains<2>; ++k)
            for (int j = 0; j < element.n_dofs(); ++j) strain[k] += points[a].strain[k][j] * u[j];
          sum[nodes[a]] +=
              von_mises<2>(problem.model().material, stress<2>(problem.model().material, strain));
          ++count[nodes[a]];
        }
      }
    }
  }
  RingField field{1, std::vector<double>(sum.size(), no_material)};
  for (size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) field.values[i] = sum[i] / count[i];
  return field;
}

RingField repeated_field(const RollingProblem<2>& problem, const LevelSet<2>& sector_values) {
  const Lattice<2> lattice = displacement_lattice(problem);
  const PolarGrid<2>& grid = lattice.grid();
  const int degree = lattice.degree(), n_sectors = grid.n_sectors;
  RingField field{1, std::vector<double>(size_t(lattice.n_nodes()) * n_sectors)};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.node_position(node);
    const std::array<int, 2> cell{std::min(p[0] / degree, grid.cells[0] - 1), p[1] / degree};
    const ShapeFunctions<2> shape(sector_values.lattice.degree(),
                                  {double(p[0]) / degree - cell[0], double(p[1]) / degree - cell[1]});
    const auto values = sector_values.cell_values(grid.cell_index(cell));
    double value = 0;
    for (size_t a = 0; a < values.size(); ++a) value += shape.value[a] * values[a];
    for (int sector = 0; sector < n_sectors; ++sector)
      field.values[node + size_t(lattice.n_nodes()) * sector] = value;
  }
  return field;
}

std::vector<ContactPoint> contact_points(const RollingProblem<2>& problem, const RollingSolution<2>& s) {
  const int n_columns = problem.model().grid.ring_columns();
  const int per_column = static_cast<int>(problem.tread().points().size());
  std::vector<ContactPoint> result;
  for (int position = 0; position < s.positions.size(); ++position) {
    const auto& contact = s.contacts[position];
    const auto& state = s.states[position];
    for (int i = 0; i < contact.n_points(); ++i) {
      const auto& point = contact.points()[i];
      const int column = (contact.zone().first_column + i / per_column + n_columns) % n_columns;
      const int row = 4 * (i % per_column);
      const double* observed = s.observations.column(position * n_columns + column);
      const Vec<2> u = rotated<2>({observed[row], observed[row + 1]}, point.angle);
      const Vec<2> traction = rotated<2>({observed[row + 2], observed[row + 3]}, point.angle);
      const double approach = u[0] + displacement<2>(state.rim, point.position)[0];
      result.push_back({position, std::atan2(point.position[1], point.position[0]), point.position[1],
                        -state.traction[i][0], traction[0], point.gap - approach});
    }
  }
  return result;
}

}  // namespace wheelwright
