#include "wheelwright/report/solution_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/base/units.h"

namespace wheelwright {
namespace {

constexpr double no_material = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Lattice<2> displacement_lattice(const RollingModel<2>& model) { return Lattice<2>(model.grid, model.degree); }

RingField vertical_field(const RingField& displacement, double ground_azimuth) {
  const double x = std::cos(ground_azimuth), y = std::sin(ground_azimuth);
  RingField field{1, {}};
  for (size_t i = 0; i < displacement.values.size(); i += 2)
    field.values.push_back(x * displacement.values[i] + y * displacement.values[i + 1]);
  return field;
}

namespace {

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

RingField von_mises_field(const RollingModel<2>& model, const CutDomain<2>& domain,
                          const RingField& displacement) {
  const Lattice<2> lattice = displacement_lattice(model);
  const PolarGrid<2>& grid = lattice.grid();
  const std::vector<double> polar = polar_values(lattice, displacement);
  std::vector<double> sum(polar.size() / 2, 0.0);
  std::vector<int> count(sum.size(), 0);
  for (int radial = 0; radial < grid.cells[0]; ++radial) {
    const Material& material = model.materials.in_row(radial);
    const ElasticElement<2> element(grid, model.degree, {radial}, material);
    std::vector<RingCellNodes<2>> cells;
    for (int column = 0; column < grid.ring_columns(); ++column)
      if (domain.active(grid.cell_index({radial, column % grid.columns()})))
        cells.push_back(ring_cell_nodes<2>(lattice, {radial, column}));
    Matrix dofs(element.n_dofs(), static_cast<int>(cells.size()));
    for (size_t c = 0; c < cells.size(); ++c)
      for (int a = 0; a < element.n_nodes(); ++a)
        std::copy_n(&polar[2 * cells[c][a]], 2, dofs.column(static_cast<int>(c)) + 2 * a);
    const Matrix strains = product(strains_at_nodes(element), Op::none, dofs, Op::none);
    for (size_t c = 0; c < cells.size(); ++c) {
      const double* strain = strains.column(static_cast<int>(c));
      for (const size_t node : std::span(cells[c]).first(element.n_nodes())) {
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

double ground_azimuth(const StateSolver<2>& solver, int position) {
  return solver.all_positions().grounds[position].azimuth(solver.model().grid);
}

/// The fields of a position that was solved for.
PositionFields fields_of_solved(const StateSolver<2>& solver, const State<2>& state,
                                const Displacement<2>& displacement, int position) {
  RingField u = displacement.at_nodes(position);
  RingField von_mises = von_mises_field(solver.model(), state.domain(), u);
  return {.lattice = displacement_lattice(solver.model()),
          .displacement = std::move(u),
          .von_mises = std::move(von_mises),
          .ground_azimuth = state.positions().grounds[position].azimuth(solver.model().grid)};
}

PositionFields mirror_image(const PositionFields& fields, double ground_azimuth) {
  return {.lattice = fields.lattice,
          .displacement = wheelwright::mirror_image<2>(fields.lattice, fields.displacement),
          .von_mises = wheelwright::mirror_image<2>(fields.lattice, fields.von_mises),
          .ground_azimuth = ground_azimuth};
}

}  // namespace

PositionFields position_fields(const StateSolver<2>& solver, const State<2>& state, int position) {
  const PositionSource source = position_sources(state.positions(), solver.model().n_positions)[position];
  const PositionFields solved = fields_of_solved(solver, state, *state.displacement(), source.solved);
  return source.is_image ? mirror_image(solved, ground_azimuth(solver, position)) : solved;
}

std::vector<PositionFields> all_position_fields(const StateSolver<2>& solver, const State<2>& state) {
  const auto displacement = state.displacement();
  const auto sources = position_sources(state.positions(), solver.model().n_positions);
  std::vector<PositionFields> all;
  for (size_t i = 0; i < sources.size(); ++i)
    all.push_back(sources[i].is_image
                      ? mirror_image(all[sources[i].solved], ground_azimuth(solver, static_cast<int>(i)))
                      : fields_of_solved(solver, state, *displacement, sources[i].solved));
  return all;
}

std::vector<NamedField> named_fields(const PositionFields& fields) {
  return {{"displacement", unit<2>(UnitKind::length), fields.displacement},
          {"von_mises", unit<2>(UnitKind::stress), fields.von_mises}};
}

RingField repeated_field(const RollingModel<2>& model, const LevelSet<2>& sector_values) {
  const Lattice<2> lattice = displacement_lattice(model);
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

std::vector<ContactPoint> points_of_solved(const StateSolver<2>& solver, const State<2>& state,
                                           int position) {
  const ObservationRows<2> rows = solver.tread_surface().rows();
  const ContactPatch<2>& contact = state.contacts()[position];
  std::vector<ContactPoint> result;
  for (const auto& point : contact.points) {
    const double* observed =
        state.observations().column(position * solver.tread_surface().n_columns + point.column);
    const double *displacement = observed + rows.displacement(point.point),
                 *traction = observed + rows.traction(point.point);
    const Vec<2> u = rotated<2>({displacement[0], displacement[1]}, point.angle);
    const double approach = u[0] + wheelwright::displacement<2>(contact.rim, point.position)[0];
    result.push_back({.position = position,
                      .azimuth = std::atan2(point.position[1], point.position[0]),
                      .x = point.position[1],
                      .pressure = -point.traction[0],
                      .normal_stress = rotated<2>({traction[0], traction[1]}, point.angle)[0],
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

std::vector<ContactPoint> contact_points(const StateSolver<2>& solver, const State<2>& state) {
  std::vector<ContactPoint> result;
  const auto sources = position_sources(state.positions(), solver.model().n_positions);
  for (size_t position = 0; position < sources.size(); ++position) {
    auto points = points_of_solved(solver, state, sources[position].solved);
    if (sources[position].is_image) points = mirror_images(std::move(points));
    for (ContactPoint& p : points) {
      p.position = static_cast<int>(position);
      result.push_back(p);
    }
  }
  return result;
}

}  // namespace wheelwright
