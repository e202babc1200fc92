#include "wheelwright/report/solution_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/base/periodic.h"
#include "wheelwright/base/units.h"

namespace wheelwright {
namespace {

constexpr double no_material = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Lattice<2> displacement_lattice(const RollingProblem<2>& problem) {
  return Lattice<2>(problem.model().grid, problem.model().degree);
}

DisplacementFields::DisplacementFields(const RollingProblem<2>& problem, const RollingSolution<2>& solution)
    : problem_(problem),
      solution_(solution),
      lattice_(displacement_lattice(problem)),
      sources_(position_sources(solution.positions, problem.model().n_positions)),
      core_(complete_displacement(solution)) {}

RingField DisplacementFields::at(int position) const {
  const PositionSource source = sources_[position];
  return source.is_image ? mirror_image<2>(lattice_, of_solved(source.solved)) : of_solved(source.solved);
}

/// v in the core: one row a sector, one column an unknown in elimination order.
Matrix DisplacementFields::core_values(int position) const {
  const int n_sectors = lattice_.grid().n_sectors;
  const Matrix weights = block(core_.weights, position * n_sectors, 0, n_sectors, core_.weights.columns());
  return product(weights, Op::none, core_.modes, Op::none);
}

/// v at the nodes above the core's outer line: one column a ring column.
Matrix DisplacementFields::tread_values(int position) const {
  const Tread<2>& tread = problem_.tread();
  const int n_sectors = lattice_.grid().n_sectors, n_columns = lattice_.grid().ring_columns();
  const auto of_position = [&](const Matrix& all, int n) {
    return block(all, 0, position * n, all.rows(), n);
  };
  const TreadLoads loads = tread_loads(tread, of_position(solution_.tread_loads, n_columns));
  return nodal_displacements(tread, tread_field(tread, of_position(solution_.outer_line, n_sectors), loads),
                             loads);
}

RingField DisplacementFields::of_solved(int position) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const RollingSolution<2>& s = solution_;
  const SectorSpace<2>& space = s.ring.sector().space;
  const int n_sectors = grid.n_sectors, degree = lattice_.degree(), per_sector = lattice_.nodes()[1];
  const int base_row = degree * problem_.core_rows(), upper_rows = degree * problem_.tread().rows();
  const Matrix core = core_values(position), tread = tread_values(position);
  const double ground_azimuth = s.positions.grounds[position].azimuth(grid);

  RingField field{2, std::vector<double>(2 * size_t(lattice_.n_nodes()) * n_sectors, no_material)};
  for (int line = 0; line < per_sector * n_sectors; ++line) {
    const int sector = line / per_sector, column = line % per_sector;
    const double azimuth = lattice_.polar_point(std::array{0, column})[1] + sector * grid.sector_angle();
    const double cosine = std::cos(azimuth), sine = std::sin(azimuth);
    const double turned_cosine = std::cos(azimuth - ground_azimuth),
                 turned_sine = std::sin(azimuth - ground_azimuth);
    for (int row = 0; row < lattice_.nodes()[0]; ++row) {
      const std::array<int, 2> p{row, column};
      Vec<2> polar{};
      if (row > base_row) {
        const int ring_column = sector * grid.columns() + column / degree;
        const double* u =
            tread.column(ring_column) + 2 * ((column % degree) * upper_rows + row - base_row - 1);
        polar = {u[0], u[1]};
      } else if (row > 0) {
        // Nodes of the first azimuth may belong to the sector before alone.
        int number = space.number(p), from = sector;
        if (number < 0 && column == 0) {
          number = space.number({row, per_sector});
          from = (sector + n_sectors - 1) % n_sectors;
        }
        if (number < 0) continue;
        polar = {core(from, s.ring.row(2 * number)), core(from, s.ring.row(2 * number + 1))};
      }
      const double radius = lattice_.polar_point(p)[0];
      const Vec<2> of_rim =
          displacement<2>(s.states[position].rim, {radius * turned_cosine, radius * turned_sine});
      // The rim's motion from the ground frame into the polar one, then both into the body frame.
      polar[0] += turned_cosine * of_rim[0] + turned_sine * of_rim[1];
      polar[1] += turned_cosine * of_rim[1] - turned_sine * of_rim[0];
      double* value = &field.values[2 * (lattice_.node_index(p) + size_t(lattice_.n_nodes()) * sector)];
      value[0] = cosine * polar[0] - sine * polar[1];
      value[1] = sine * polar[0] + cosine * polar[1];
    }
  }
  return field;
}

RingField displacement_field(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                             int position) {
  return DisplacementFields(problem, solution).at(position);
}

RingField vertical_field(const RingField& displacement, double ground_azimuth) {
  const double x = std::cos(ground_azimuth), y = std::sin(ground_azimuth);
  RingField field{1, {}};
  for (size_t i = 0; i < displacement.values.size(); i += 2)
    field.values.push_back(x * displacement.values[i] + y * displacement.values[i + 1]);
  return field;
}

namespace {

/// The nodes of the full ring that a cell of a row of cells has, in local order.
std::vector<size_t> cell_nodes(const Lattice<2>& lattice, int radial, int ring_column) {
  std::vector<size_t> nodes;
  for (int a = 0; a < nodes_per_cell<2>(lattice.degree()); ++a) {
    auto p = local_node_position<2>(lattice.degree(), a);
    p[0] += lattice.degree() * radial;
    p[1] += lattice.degree() * ring_column;
    nodes.push_back(ring_node<2>(lattice, p));
  }
  return nodes;
}

/// Strains at the nodes of a cell of this row as a linear map of its dofs: n_strains rows a node.
Matrix strains_at_nodes(const ElasticElement<2>& element) {
  const int degree = element.degree();
  Matrix map(n_strains<2> * element.n_nodes(), element.n_dofs());
  for (int a = 0; a < element.n_nodes(); ++a) {
    const auto p = local_node_position<2>(degree, a);
    const auto point = element.at({double(p[0]) / degree, double(p[1]) / degree});
    for (int k = 0; k < n_strains<2>; ++k)
      for (int j = 0; j < element.n_dofs(); ++j) map(n_strains<2> * a + k, j) = point.strain[k][j];
  }
  return map;
}

/// The field's vectors in polar components.
std::vector<double> polar_values(const Lattice<2>& lattice, const RingField& field) {
  std::vector<double> polar = field.values;
  const int per_sector = lattice.nodes()[1];
  for (int line = 0; line < per_sector * lattice.grid().n_sectors; ++line) {
    const double azimuth = lattice.polar_point(std::array{0, line % per_sector})[1] +
                           line / per_sector * lattice.grid().sector_angle();
    const double cosine = std::cos(azimuth), sine = std::sin(azimuth);
    for (int row = 0; row < lattice.nodes()[0]; ++row) {
      double* u = &polar[2 * ring_node<2>(lattice, {row, line})];
      const Vec<2> cartesian{u[0], u[1]};
      u[0] = cosine * cartesian[0] + sine * cartesian[1];
      u[1] = cosine * cartesian[1] - sine * cartesian[0];
    }
  }
  return polar;
}

}  // namespace

RingField von_mises_field(const RollingProblem<2>& problem, const RollingSolution<2>& s,
                          const RingField& displacement) {
  const Lattice<2> lattice = displacement_lattice(problem);
  const PolarGrid<2>& grid = lattice.grid();
  const Material& material = problem.model().material;
  const std::vector<double> polar = polar_values(lattice, displacement);
  std::vector<double> sum(polar.size() / 2, 0.0);
  std::vector<int> count(sum.size(), 0);
  for (int radial = 0; radial < grid.cells[0]; ++radial) {
    const auto& element = problem.elements().element(radial);
    std::vector<std::vector<size_t>> cells;
    for (int column = 0; column < grid.ring_columns(); ++column)
      if (s.domain.active(grid.cell_index({radial, column % grid.columns()})))
        cells.push_back(cell_nodes(lattice, radial, column));
    Matrix dofs(element.n_dofs(), static_cast<int>(cells.size()));
    for (size_t c = 0; c < cells.size(); ++c)
      for (size_t a = 0; a < cells[c].size(); ++a)
        std::copy_n(&polar[2 * cells[c][a]], 2, dofs.column(static_cast<int>(c)) + 2 * a);
    const Matrix strains = product(strains_at_nodes(element), Op::none, dofs, Op::none);
    for (size_t c = 0; c < cells.size(); ++c) {
      const double* strain = strains.column(static_cast<int>(c));
      for (const size_t node : cells[c]) {
        sum[node] += von_mises<2>(material, stress<2>(material, {strain[0], strain[1], strain[2]}));
        ++count[node];
        strain += n_strains<2>;
      }
    }
  }
  RingField field{1, std::vector<double>(sum.size(), no_material)};
  for (size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) field.values[i] = sum[i] / count[i];
  return field;
}

namespace {

double ground_azimuth(const RollingProblem<2>& problem, int position) {
  return problem.positions().grounds[position].azimuth(problem.model().grid);
}

}  // namespace

PositionFields position_fields(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                               int position) {
  RingField displacement = displacement_field(problem, solution, position);
  RingField von_mises = von_mises_field(problem, solution, displacement);
  return {displacement_lattice(problem), std::move(displacement), std::move(von_mises),
          ground_azimuth(problem, position)};
}

std::vector<PositionFields> all_position_fields(const RollingProblem<2>& problem,
                                                const RollingSolution<2>& solution) {
  const Lattice<2> lattice = displacement_lattice(problem);
  const DisplacementFields displacements(problem, solution);
  const auto sources = position_sources(solution.positions, problem.model().n_positions);
  std::vector<PositionFields> all;
  for (int i = 0; i < displacements.n_positions(); ++i) {
    if (sources[i].is_image) {
      const PositionFields& image = all[sources[i].solved];
      all.push_back({lattice, mirror_image<2>(lattice, image.displacement),
                     mirror_image<2>(lattice, image.von_mises), ground_azimuth(problem, i)});
    } else {
      RingField displacement = displacements.at(i);
      RingField von_mises = von_mises_field(problem, solution, displacement);
      all.push_back({lattice, std::move(displacement), std::move(von_mises), ground_azimuth(problem, i)});
    }
  }
  return all;
}

std::vector<NamedField> named_fields(const PositionFields& fields) {
  return {{"displacement", unit<2>(UnitKind::length), fields.displacement},
          {"von_mises", unit<2>(UnitKind::stress), fields.von_mises}};
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

namespace {

std::vector<ContactPoint> points_of_solved(const RollingProblem<2>& problem, const RollingSolution<2>& s,
                                           int position) {
  const int n_columns = problem.model().grid.ring_columns();
  const int per_column = static_cast<int>(problem.tread().points().size());
  const auto& contact = s.contacts[position];
  const auto& state = s.states[position];
  std::vector<ContactPoint> result;
  for (int i = 0; i < contact.n_points(); ++i) {
    const auto& point = contact.points()[i];
    const int column = wrap(contact.zone().first_column + i / per_column, n_columns);
    const int row = 4 * (i % per_column);
    const double* observed = s.observations.column(position * n_columns + column);
    const Vec<2> u = rotated<2>({observed[row], observed[row + 1]}, point.angle);
    const Vec<2> traction = rotated<2>({observed[row + 2], observed[row + 3]}, point.angle);
    const double approach = u[0] + displacement<2>(state.rim, point.position)[0];
    result.push_back({.position = position,
                      .azimuth = std::atan2(point.position[1], point.position[0]),
                      .x = point.position[1],
                      .pressure = -state.traction[i][0],
                      .normal_stress = traction[0],
                      .gap = point.gap - approach});
  }
  return result;
}

/// What the mirror image of a load position shows, in the same order along the ground.
std::vector<ContactPoint> mirror_images(std::vector<ContactPoint> points) {
  std::ranges::reverse(points);
  for (ContactPoint& p : points) {
    p.azimuth = -p.azimuth;
    p.x = -p.x;
  }
  return points;
}

}  // namespace

std::vector<ContactPoint> contact_points(const RollingProblem<2>& problem, const RollingSolution<2>& s) {
  std::vector<ContactPoint> result;
  const auto sources = position_sources(s.positions, problem.model().n_positions);
  for (size_t position = 0; position < sources.size(); ++position) {
    auto points = points_of_solved(problem, s, sources[position].solved);
    if (sources[position].is_image) points = mirror_images(std::move(points));
    for (ContactPoint& p : points) {
      p.position = static_cast<int>(position);
      result.push_back(p);
    }
  }
  return result;
}

}  // namespace wheelwright
