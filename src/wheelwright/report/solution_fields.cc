#include "wheelwright/report/solution_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/analysis/strain_peaks.h"
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

namespace {

/// A stress in the plane, given in a frame whose first axis lies at this azimuth, as components in the body
/// frame: xx, yy, zz, xy.
std::array<double, 4> in_body_frame(const Voigt<2>& s, double azimuth, double axial_stress_ratio) {
  const double c = std::cos(azimuth), d = std::sin(azimuth);
  return {c * c * s[0] + d * d * s[1] - 2 * c * d * s[2], d * d * s[0] + c * c * s[1] + 2 * c * d * s[2],
          axial_stress_ratio * (s[0] + s[1]), c * d * (s[0] - s[1]) + (c * c - d * d) * s[2]};
}

double von_mises_of(std::span<const double> s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * s[3] * s[3]);
}

/// A cell with material and its column round the ring.
struct RingCell {
  int column;
  RingCellNodes<2> nodes;
};

std::vector<RingCell> active_cells(const Lattice<2>& lattice, const CutDomain<2>& domain, int row) {
  const PolarGrid<2>& grid = lattice.grid();
  std::vector<RingCell> cells;
  for (int column = 0; column < grid.ring_columns(); ++column)
    if (domain.active(grid.cell_index({row, column % grid.columns()})))
      cells.push_back({column, ring_cell_nodes<2>(lattice, {row, column})});
  return cells;
}

}  // namespace

RingField stress_field(const RollingModel<2>& model, const CutDomain<2>& domain,
                       const RingField& displacement) {
  const Lattice<2> lattice = displacement_lattice(model);
  const PolarGrid<2>& grid = lattice.grid();
  const std::vector<double> polar = polar_values(lattice, displacement);
  std::vector<std::array<double, 4>> sum(polar.size() / 2, std::array<double, 4>{});
  std::vector<int> count(sum.size(), 0);
  for (int row = 0; row < grid.cells[0]; ++row) {
    const Material& material = model.materials.in_row(row);
    const ElasticElement<2> element(grid, model.degree, {row}, material);
    const std::vector<RingCell> cells = active_cells(lattice, domain, row);
    Matrix dofs(element.n_dofs(), static_cast<int>(cells.size()));
    for (size_t c = 0; c < cells.size(); ++c)
      for (int a = 0; a < element.n_nodes(); ++a)
        std::copy_n(&polar[2 * cells[c].nodes[a]], 2, dofs.column(static_cast<int>(c)) + 2 * a);
    const Matrix strains = product(strains_at_nodes(element), Op::none, dofs, Op::none);
    for (size_t c = 0; c < cells.size(); ++c) {
      const double* strain = strains.column(static_cast<int>(c));
      for (const size_t node : std::span(cells[c].nodes).first(element.n_nodes())) {
        const auto at_node =
            in_body_frame(stress<2>(material, {strain[0], strain[1], strain[2]}),
                          cells[c].column * grid.cell_size()[1], material.axial_stress_ratio());
        for (int k = 0; k < 4; ++k) sum[node][k] += at_node[k];
        ++count[node];
        strain += n_strains<2>;
      }
    }
  }
  RingField field{4, std::vector<double>(4 * sum.size(), no_material)};
  for (size_t i = 0; i < sum.size(); ++i)
    for (int k = 0; k < 4 && count[i] > 0; ++k) field.values[4 * i + k] = sum[i][k] / count[i];
  return field;
}

NamedField von_mises_field(const RingField& stress) {
  return {"von_mises", unit<2>(UnitKind::stress), stress, von_mises_of};
}

namespace {

double ground_azimuth(const StateSolver<2>& solver, int position) {
  return solver.all_positions().grounds[position].azimuth(solver.model().grid);
}

template <int dim>
std::vector<ContactPoint> points_of_solved(const StateSolver<dim>& solver, const State<dim>& state,
                                           int position) {
  const ObservationRows<dim> rows = solver.tread_surface().rows();
  const ContactPatch<dim>& contact = state.contacts()[position];
  std::vector<ContactPoint> result;
  for (const auto& point : contact.points) {
    const double* observed =
        state.observations().column(position * solver.tread_surface().n_columns + point.column);
    const auto in_ground_frame = [&](int first_row) {
      Vec<dim> v;
      std::copy_n(observed + first_row, dim, v.begin());
      return rotated<dim>(v, point.angle);
    };
    const Vec<dim> u = in_ground_frame(rows.displacement(point.point)),
                   stress = in_ground_frame(rows.traction(point.point));
    const double approach = u[0] + wheelwright::displacement<dim>(contact.rim, point.position)[0];
    ContactPoint seen{.position = position,
                      .azimuth = std::atan2(point.position[1], point.position[0]),
                      .x = point.position[1],
                      .weight = point.weight,
                      .pressure = -point.traction[0],
                      .friction = point.traction[1],
                      .normal_stress = stress[0],
                      .gap = point.gap - approach};
    if constexpr (dim == 3) {
      seen.z = point.position[2] - 0.5 * solver.model().grid.width;
      seen.axial_friction = point.traction[2];
    }
    result.push_back(seen);
  }
  return result;
}

/// What the mirror image of a load position shows, in the same order along the ground.
std::vector<ContactPoint> mirror_images(std::vector<ContactPoint> points) {
  std::ranges::reverse(points);
  for (ContactPoint& p : points) {
    p.azimuth = -p.azimuth;
    p.x = -p.x;
    p.friction = -p.friction;
  }
  return points;
}

template <int dim>
std::vector<ContactPoint> points_at(const StateSolver<dim>& solver, const State<dim>& state,
                                    const PositionSource& source, int position) {
  auto points = points_of_solved(solver, state, source.solved);
  if (source.is_image) points = mirror_images(std::move(points));
  for (ContactPoint& p : points) p.position = position;
  return points;
}

RimMotion mirror_image(const RimMotion& rim) {
  return {rim.towards_ground, -rim.along_ground, -rim.rotation};
}
RimForce mirror_image(const RimForce& force) {
  return {force.towards_ground, -force.along_ground, -force.torque};
}

DrawnPeak peak_at(const PolarGrid<2>& grid, const StrainPeaks<2>& peaks, const PositionSource& source) {
  Vec<2> polar = peaks.von_mises_places[source.solved];
  if (source.is_image) polar[1] = grid.sector_angle() - polar[1];
  return {cartesian<2>(polar), peaks.von_mises[source.solved]};
}

/// The fields of one load position, from the displacements and peaks of those that were solved for.
PositionFields fields_at(const StateSolver<2>& solver, const State<2>& state,
                         const Displacement<2>& displacement, const StrainPeaks<2>& peaks,
                         const PositionSource& source, int position) {
  const ContactPatch<2>& contact = state.contacts()[source.solved];
  const Lattice<2> lattice = displacement_lattice(solver.model());
  const RingField solved = displacement.at_nodes(source.solved);
  const RingField u = source.is_image ? wheelwright::mirror_image<2>(lattice, solved) : solved;
  return {.lattice = lattice,
          .displacement = u,
          .stress = stress_field(solver.model(), state.domain(), u),
          .ground_azimuth = ground_azimuth(solver, position),
          .rim = source.is_image ? mirror_image(contact.rim) : contact.rim,
          .rim_force = source.is_image ? mirror_image(contact.rim_force) : contact.rim_force,
          .contact = points_at(solver, state, source, position),
          .von_mises = peak_at(lattice.grid(), peaks, source)};
}

}  // namespace

PositionFields position_fields(const StateSolver<2>& solver, const State<2>& state, int position) {
  const auto sources = position_sources(state.positions(), solver.model().n_positions);
  const auto displacement = state.displacement();
  return fields_at(solver, state, *displacement, strain_peaks(solver, state, *displacement),
                   sources[position], position);
}

std::vector<PositionFields> all_position_fields(const StateSolver<2>& solver, const State<2>& state) {
  const auto displacement = state.displacement();
  const auto peaks = strain_peaks(solver, state, *displacement);
  std::vector<PositionFields> all;
  for (const PositionSource& source : position_sources(state.positions(), solver.model().n_positions))
    all.push_back(fields_at(solver, state, *displacement, peaks, source, static_cast<int>(all.size())));
  return all;
}

std::vector<NamedField> named_fields(const PositionFields& fields) {
  return {{"displacement", unit<2>(UnitKind::length), fields.displacement},
          {"stress", unit<2>(UnitKind::stress), fields.stress},
          von_mises_field(fields.stress)};
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

template <int dim>
std::vector<ContactPoint> contact_points(const StateSolver<dim>& solver, const State<dim>& state) {
  std::vector<ContactPoint> result;
  const auto sources = position_sources(state.positions(), solver.model().n_positions);
  for (size_t position = 0; position < sources.size(); ++position)
    std::ranges::copy(points_at(solver, state, sources[position], static_cast<int>(position)),
                      std::back_inserter(result));
  return result;
}

template std::vector<ContactPoint> contact_points(const StateSolver<2>&, const State<2>&);
template std::vector<ContactPoint> contact_points(const StateSolver<3>&, const State<3>&);

}  // namespace wheelwright
