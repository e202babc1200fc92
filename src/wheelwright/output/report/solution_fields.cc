#include "wheelwright/output/report/solution_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/base/units.h"
#include "wheelwright/mechanics/elasticity/voigt_indices.h"
#include "wheelwright/output/report/cell_means.h"
#include "wheelwright/output/report/fatigue_field.h"
#include "wheelwright/output/report/temperature_picture.h"
#include "wheelwright/quantities/analysis/shape_summary.h"

namespace wheelwright {
namespace {

constexpr double no_material = std::numeric_limits<double>::quiet_NaN();
constexpr const char* von_mises_name = "von_mises";

}  // namespace

template <int dim>
Lattice<dim> displacement_lattice(const RollingModel<dim>& model) {
  return Lattice<dim>(model.grid, model.degree);
}

template <int dim>
std::vector<int> layers_of_rows(const RollingModel<dim>& model) {
  std::vector<int> result;
  if (model.materials.layers().size() > 1)
    for (int row = 0; row < model.grid.cells[0]; ++row)
      result.push_back(model.materials.layer_at(model.grid.middle_of_row(row)));
  return result;
}

template <int dim>
std::vector<bool> rows_of_odd_layers(const RollingModel<dim>& model) {
  std::vector<bool> result;
  for (const int layer : layers_of_rows(model)) result.push_back(layer % 2 == 1);
  return result;
}

template <int dim>
RingField vertical_field(const RingField& displacement, double ground_azimuth) {
  const double x = std::cos(ground_azimuth), y = std::sin(ground_azimuth);
  RingField field{1, {}};
  for (size_t i = 0; i < displacement.values.size(); i += dim)
    field.values.push_back(x * displacement.values[i] + y * displacement.values[i + 1]);
  return field;
}

namespace {

/// A node of a cell in the unit cell.
template <int dim>
Vec<dim> place_of_node(int degree, int node) {
  Vec<dim> xi;
  for (int d = 0; d < dim; ++d) xi[d] = double(local_node_position<dim>(degree, node)[d]) / degree;
  return xi;
}

/// Strains at the nodes of a cell of this row as a linear map of its dofs: n_strains rows a node.
template <int dim>
Matrix strains_at_nodes(const ElasticElement<dim>& element) {
  const int degree = element.degree();
  Matrix map(n_strains<dim> * element.n_nodes(), element.n_dofs());
  for (int a = 0; a < element.n_nodes(); ++a) {
    const auto point = element.at(place_of_node<dim>(degree, a));
    for (int k = 0; k < n_strains<dim>; ++k)
      for (int j = 0; j < element.n_dofs(); ++j) map(n_strains<dim> * a + k, j) = point.strain[k][j];
  }
  return map;
}

/// The field's vectors in polar components.
template <int dim>
std::vector<double> polar_values(const Lattice<dim>& lattice, const RingField& field) {
  std::vector<double> polar = field.values;
  const int per_sector = lattice.nodes()[1], per_line = lattice.nodes_per_line();
  for (int line = 0; line < per_sector * lattice.grid().n_sectors; ++line) {
    const int sector = line / per_sector;
    const double azimuth =
        (line % per_sector) * lattice.node_angle() + sector * lattice.grid().sector_angle();
    const double cosine = std::cos(azimuth), sine = std::sin(azimuth);
    double* u = &polar[dim * ring_node<dim>(lattice, {0, line})];
    for (int node = 0; node < per_line; ++node, u += dim) {
      const Vec<2> cartesian{u[0], u[1]};
      u[0] = cosine * cartesian[0] + sine * cartesian[1];
      u[1] = cosine * cartesian[1] - sine * cartesian[0];
    }
  }
  return polar;
}

}  // namespace

namespace {

/// An azimuth by its cosine and sine.
struct Direction {
  double cosine, sine;
};

/// The azimuth that is the sum of both.
Direction sum(const Direction& a, const Direction& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

/// The first axes of the strains at the nodes of a cell, in its frame.
template <int dim>
std::vector<Direction> axes_at_nodes(const ElasticElement<dim>& element) {
  std::vector<Direction> axes;
  for (int a = 0; a < element.n_nodes(); ++a) {
    const double azimuth =
        element.azimuth_of_strains(element.with_own_strain(place_of_node<dim>(element.degree(), a)).position);
    axes.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
  return axes;
}

/// A stress, given in a frame whose first axis points in this direction, as components in the body frame.
std::array<double, 4> in_body_frame(const Voigt<2>& s, const Direction& axis, double axial_stress) {
  const auto [c, d] = axis;
  return {c * c * s[0] + d * d * s[1] - 2 * c * d * s[2], d * d * s[0] + c * c * s[1] + 2 * c * d * s[2],
          axial_stress, c * d * (s[0] - s[1]) + (c * c - d * d) * s[2]};
}

std::array<double, 6> in_body_frame(const Voigt<3>& s, const Direction& axis, double) {
  const auto [c, d] = axis;
  return {c * c * s[0] + d * d * s[1] - 2 * c * d * s[5],
          d * d * s[0] + c * c * s[1] + 2 * c * d * s[5],
          s[2],
          c * d * (s[0] - s[1]) + (c * c - d * d) * s[5],
          d * s[4] + c * s[3],
          c * s[4] - d * s[3]};
}

/// The normal stress along the axle in addition to the components in the model's dimension.
template <int dim>
double axial_stress(const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
  double stress = 0, ignored = 0;
  if (dim == 2) law.along_axle(one_strain<dim>(strain), {&stress, 1}, {&ignored, 1});
  return stress;
}

/// du_i / dx_j at a node of a cell, in its frame.
template <int dim>
Mat<dim> gradient_at_node(const ElasticElement<dim>& element, int node, const double* dofs) {
  const auto map = element.gradient(place_of_node<dim>(element.degree(), node));
  Mat<dim> gradient{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < element.n_dofs(); ++k) gradient[i][j] += map[dim * i + j][k] * dofs[k];
  return gradient;
}

/// Cauchy's stress of a law of large strains; when dim = 2 with that along the axle.
template <int dim>
struct TrueStress {
  Voigt<dim> in_plane;
  double axial = 0;
};
template <int dim>
TrueStress<dim> true_stress(const MaterialLaw<dim>& law, Mat<dim> f) {
  for (int i = 0; i < dim; ++i) f[i][i] += 1;
  constexpr auto indices = voigt_indices<dim>();
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto [a, b] = indices[k];
    double product = 0;
    for (int i = 0; i < dim; ++i) product += f[i][a] * f[i][b];
    strain[k] = a == b ? 0.5 * (product - 1) : product;
  }
  TrueStress<dim> result;
  double axial_strain = 0;
  if (dim == 2) law.along_axle(one_strain<dim>(strain), {&result.axial, 1}, {&axial_strain, 1});
  const Voigt<dim> second = stress<dim>(law, strain);  // of Piola and Kirchhoff
  Mat<dim> s{};
  for (int k = 0; k < n_strains<dim>; ++k)
    s[indices[k][0]][indices[k][1]] = s[indices[k][1]][indices[k][0]] = second[k];
  const double j = determinant<dim>(f) * std::sqrt(1 + 2 * axial_strain);
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto [a, b] = indices[k];
    double sum = 0;
    for (int m = 0; m < dim; ++m)
      for (int n = 0; n < dim; ++n) sum += f[a][m] * s[m][n] * f[b][n];
    result.in_plane[k] = sum / j;
  }
  return result;
}

/// Means of the values that cells have at their nodes.
template <int components>
class NodalMeans {
 public:
  explicit NodalMeans(size_t n_nodes)
      : sums_(n_nodes, std::array<double, components>{}), counts_(n_nodes, 0) {}

  void add(size_t node, const std::array<double, components>& value) {
    for (int k = 0; k < components; ++k) sums_[node][k] += value[k];
    ++counts_[node];
  }

  std::vector<double> values() const {
    std::vector<double> result(components * sums_.size(), no_material);
    for (size_t i = 0; i < sums_.size(); ++i)
      for (int k = 0; k < components && counts_[i] > 0; ++k)
        result[components * i + k] = sums_[i][k] / counts_[i];
    return result;
  }

 private:
  std::vector<std::array<double, components>> sums_;
  std::vector<int> counts_;
};

/// A cell with material and its column round the ring.
template <int dim>
struct RingCell {
  int column;
  RingCellNodes<dim> nodes;
};

template <int dim>
std::vector<RingCell<dim>> active_cells(const Lattice<dim>& lattice, const CutDomain<dim>& domain, int row) {
  const PolarGrid<dim>& grid = lattice.grid();
  const int axial_cells = grid.n_cells() / (grid.cells[0] * grid.columns());
  std::vector<RingCell<dim>> cells;
  std::array<int, dim> place{row};
  for (int column = 0; column < grid.ring_columns(); ++column)
    for (int axial = 0; axial < axial_cells; ++axial) {
      if constexpr (dim == 3) place[2] = axial;
      place[1] = column % grid.columns();
      if (!domain.active(grid.cell_index(place))) continue;
      place[1] = column;
      cells.push_back({column, ring_cell_nodes<dim>(lattice, place)});
    }
  return cells;
}

}  // namespace

template <int dim>
RingField stress_field(const RollingModel<dim>& model, const CutDomain<dim>& domain,
                       const RingField& displacement) {
  constexpr int components = stress_components<dim>;
  const Lattice<dim> lattice = displacement_lattice(model);
  const PolarGrid<dim>& grid = lattice.grid();
  const std::vector<double> polar = polar_values(lattice, displacement);
  const std::vector<bool> is_odd_row = rows_of_odd_layers(model);
  NodalMeans<components> means(polar.size() / dim), odd_means(is_odd_row.empty() ? 0 : polar.size() / dim);
  std::vector<Direction> of_column;
  for (int column = 0; column < grid.ring_columns(); ++column) {
    const double azimuth = column * grid.column_angle();
    of_column.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
  for (int row = 0; row < grid.cells[0]; ++row) {
    NodalMeans<components>& of_row = is_odd_row.empty() || !is_odd_row[row] ? means : odd_means;
    const MaterialLaw<dim>& law = model.materials.in_row(grid, row);
    const ElasticElement<dim> element(grid, model.degree, {row}, law, model.dilatation);
    const std::vector<RingCell<dim>> cells = active_cells(lattice, domain, row);
    Matrix dofs(element.n_dofs(), static_cast<int>(cells.size()));
    for (size_t c = 0; c < cells.size(); ++c)
      for (int a = 0; a < element.n_nodes(); ++a)
        std::copy_n(&polar[dim * cells[c].nodes[a]], dim, dofs.column(static_cast<int>(c)) + dim * a);
    const Matrix strains = product(strains_at_nodes(element), Op::none, dofs, Op::none);
    const std::vector<Direction> axes = axes_at_nodes(element);
    for (size_t c = 0; c < cells.size(); ++c) {
      const double* strain = strains.column(static_cast<int>(c));
      for (int a = 0; a < element.n_nodes(); ++a, strain += n_strains<dim>) {
        Voigt<dim> at_point;
        std::copy_n(strain, n_strains<dim>, at_point.begin());
        const Direction axis = sum(of_column[cells[c].column], axes[a]);
        if (law.is_linear()) {
          of_row.add(cells[c].nodes[a],
                     in_body_frame(stress<dim>(law, at_point), axis, axial_stress<dim>(law, at_point)));
        } else {
          const TrueStress<dim> found =
              true_stress<dim>(law, gradient_at_node(element, a, dofs.column(static_cast<int>(c))));
          of_row.add(cells[c].nodes[a], in_body_frame(found.in_plane, axis, found.axial));
        }
      }
    }
  }
  return {components, means.values(), is_odd_row, odd_means.values()};
}

double von_mises_of(std::span<const double> s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  double shear = 0;
  for (const double t : s.subspan(3)) shear += t * t;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * shear);
}

NamedField von_mises_field(const RingField& stress) {
  return {von_mises_name, unit<2>(UnitKind::stress), stress, von_mises_of};
}

namespace {

template <int dim>
double ground_azimuth(const StateSolver<dim>& solver, int position) {
  return solver.all_positions().grounds[position].azimuth(solver.model().grid);
}

/// The cell at the tread in which each contact point of a column lies, from the column's first azimuth.
template <int dim>
std::vector<int> cells_of_points(const TreadSurface<dim>& surface) {
  std::vector<int> cells(surface.points.size());
  for (const FaceRow& row : surface.face_rows) {
    const bool of_displacements = row.first < 2 * std::ssize(surface.points) && row.first % 2 == 0;
    if (!of_displacements) continue;
    for (int face = 0; face < row.faces; ++face)
      for (int point = 0; point < row.points_per_face; ++point)
        cells[row.observation(face, point) / 2] = face;
  }
  return cells;
}

template <int dim>
std::vector<ContactPoint> points_of_solved(const StateSolver<dim>& solver, const State<dim>& state,
                                           int position) {
  const ObservationRows<dim> rows = solver.tread_surface().rows();
  const ContactPatch<dim>& contact = state.contacts()[position];
  const std::vector<int> cells = cells_of_points(solver.tread_surface());
  const int per_column = 1 + std::ranges::max(cells);
  std::vector<ContactPoint> result;
  for (const auto& point : contact.points) {
    const double* observed =
        state.observations().column(position * solver.tread_surface().n_columns + point.column);
    const auto in_contact_frame = [&](int row) {
      Vec<dim> v;
      std::copy_n(observed + row, dim, v.begin());
      return point.frame.template to_contact<dim>(v);
    };
    const Vec<dim> of_rim = point.frame.template ground_to_contact<dim>(
        wheelwright::displacement<dim>(contact.rim, point.position));
    const double approach = in_contact_frame(rows.displacement(point.point))[0] + of_rim[0];
    result.push_back({.position = position,
                      .azimuth = std::atan2(point.position[1], point.position[0]),
                      .x = point.place()[1],
                      .weight = point.area(),
                      .pressure = point.pressure(),
                      .friction = point.stress()[1],
                      .normal_stress = in_contact_frame(rows.traction(point.point))[0] / point.stretch,
                      .gap = point.gap - approach,
                      .cell = per_column * point.column + cells[point.point]});
    if constexpr (dim == 3) {
      result.back().z = point.place()[2];
      result.back().axial_friction = point.stress()[2];
    }
  }
  return result;
}

/// The contact of the mirror image of a load position, in the same order along the ground.
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

template <int dim>
DrawnPeak<dim> peak_at(const PolarGrid<dim>& grid, const StrainPeaks<dim>& peaks,
                       const PositionSource& source) {
  Vec<dim> polar = peaks.von_mises_places[source.solved];
  if (source.is_image) polar[1] = grid.sector_angle() - polar[1];
  return {cartesian<dim>(polar), peaks.von_mises[source.solved]};
}

/// The fields of one load position, from the displacements and peaks of those that were solved for.
template <int dim>
PositionFields<dim> fields_at(const StateSolver<dim>& solver, const State<dim>& state,
                              const PositionSource& source, int position) {
  const ContactPatch<dim>& contact = state.contacts()[source.solved];
  const Lattice<dim> lattice = displacement_lattice(solver.model());
  const RingField solved = state.displacement().at_nodes(source.solved);
  const RingField u = source.is_image ? wheelwright::mirror_image<dim>(lattice, solved) : solved;
  return {.lattice = lattice,
          .displacement = u,
          .stress = stress_field(solver.model(), state.domain(), u),
          .ground_azimuth = ground_azimuth(solver, position),
          .is_bonded = solver.model().contact.counterpart == Counterpart::ring,
          .is_large = !solver.model().materials.are_linear(),
          .ground = state.model().ground,
          .camber = state.model().camber,
          .rim = source.is_image ? mirror_image(contact.rim) : contact.rim,
          .travel = contact.travel(),
          .rim_force = source.is_image ? mirror_image(contact.rim_force) : contact.rim_force,
          .contact = points_at(solver, state, source, position),
          .von_mises = peak_at(lattice.grid(), state.strain_peaks(), source),
          .layers = layer_circles(solver.model().materials)};
}

}  // namespace

template <int dim>
PositionFields<dim> position_fields(const StateSolver<dim>& solver, const State<dim>& state, int position) {
  const auto sources = position_sources(state.positions(), solver.model().n_positions);
  return fields_at(solver, state, sources[position], position);
}

template <int dim>
PositionFields<dim> most_stressed_fields(const StateSolver<dim>& solver, const State<dim>& state,
                                         const LoadCases<dim>& cases) {
  PositionFields<dim> fields = position_fields(solver, state, most_stressed_position(state));
  fields.fatigue = fatigue_field(solver, state, cases);
  fields.temperature = temperature_picture(solver, state);
  return fields;
}

template <int dim>
void for_each_position(const StateSolver<dim>& solver, const State<dim>& state,
                       const std::function<void(int, PositionFields<dim>)>& visit) {
  int position = 0;
  for (const PositionSource& source : position_sources(state.positions(), solver.model().n_positions)) {
    visit(position, fields_at(solver, state, source, position));
    ++position;
  }
}

template <int dim>
std::vector<NamedField> named_fields(const PositionFields<dim>& fields) {
  std::vector<NamedField> named{{"displacement", unit<dim>(UnitKind::length), fields.displacement},
                                {.name = "stress",
                                 .unit = unit<dim>(UnitKind::stress),
                                 .field = fields.stress,
                                 .beside = {{von_mises_name, unit<dim>(UnitKind::stress), von_mises_of}}}};
  if (fields.fatigue) named.push_back(*fields.fatigue);
  if (fields.temperature)
    named.push_back({"temperature", unit<dim>(UnitKind::temperature), *fields.temperature});
  return named;
}

template <int dim>
RingField repeated_field(const RollingModel<dim>& model, const LevelSet<dim>& sector_values) {
  const Lattice<dim> lattice = displacement_lattice(model);
  const PolarGrid<dim>& grid = lattice.grid();
  const int degree = lattice.degree(), n_sectors = grid.n_sectors;
  RingField field{1, std::vector<double>(size_t(lattice.n_nodes()) * n_sectors)};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.node_position(node);
    std::array<int, dim> cell;
    Vec<dim> xi;
    for (int d = 0; d < dim; ++d) {
      cell[d] = std::min(p[d] / degree, grid.cells[d] - 1);
      xi[d] = double(p[d]) / degree - cell[d];
    }
    const ShapeFunctions<dim> shape(sector_values.lattice.degree(), xi);
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

template <int dim>
std::vector<ContactPoint> curve_points(std::vector<ContactPoint> points) {
  if constexpr (dim == 3) {
    double nearest = INFINITY;
    for (const ContactPoint& p : points) nearest = std::abs(p.z) < std::abs(nearest) ? p.z : nearest;
    std::erase_if(points, [&](const ContactPoint& p) { return std::abs(p.z - nearest) > 1e-9; });
  }
  return cell_means(points);
}

template decltype(position_fields<2>) position_fields<2>;
template decltype(most_stressed_fields<2>) most_stressed_fields<2>;
template decltype(most_stressed_fields<3>) most_stressed_fields<3>;
template decltype(for_each_position<2>) for_each_position<2>;
template decltype(named_fields<2>) named_fields<2>;
template Lattice<2> displacement_lattice(const RollingModel<2>&);
template decltype(layers_of_rows<2>) layers_of_rows<2>;
template decltype(layers_of_rows<3>) layers_of_rows<3>;
template decltype(rows_of_odd_layers<2>) rows_of_odd_layers<2>;
template decltype(rows_of_odd_layers<3>) rows_of_odd_layers<3>;
template decltype(vertical_field<2>) vertical_field<2>;
template decltype(stress_field<2>) stress_field<2>;
template decltype(repeated_field<2>) repeated_field<2>;
template decltype(contact_points<2>) contact_points<2>;
template decltype(curve_points<2>) curve_points<2>;
template decltype(position_fields<3>) position_fields<3>;
template decltype(for_each_position<3>) for_each_position<3>;
template decltype(named_fields<3>) named_fields<3>;
template Lattice<3> displacement_lattice(const RollingModel<3>&);
template decltype(vertical_field<3>) vertical_field<3>;
template decltype(stress_field<3>) stress_field<3>;
template decltype(repeated_field<3>) repeated_field<3>;
template decltype(contact_points<3>) contact_points<3>;
template decltype(curve_points<3>) curve_points<3>;

}  // namespace wheelwright
