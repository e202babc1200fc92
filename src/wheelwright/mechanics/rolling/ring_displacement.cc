#include "wheelwright/mechanics/rolling/ring_displacement.h"

#include <array>
#include <cmath>
#include <limits>

#include "wheelwright/shape/geometry/axle_rotation.h"

namespace wheelwright {
template <int dim>
RingDisplacement<dim>::RingDisplacement(const RollingProblem<dim>& problem,
                                        const RollingSolution<dim>& solution)
    : problem_(problem),
      solution_(solution),
      lattice_(problem.model().grid, problem.model().degree),
      core_(complete_displacement(solution)),
      tread_cells_(problem.tread(), problem.model().grid, problem.model().degree) {
  const TreadLoads loads = tread_loads(problem.tread(), solution.tread_loads);
  tread_ = tread_field(problem.tread(), solution.outer_line, loads);
  tread_nodes_ = nodal_displacements(problem.tread(), tread_, loads);
}

/// v in the core: one row per sector, one column per unknown in elimination order.
template <int dim>
Matrix RingDisplacement<dim>::core_values(int position) const {
  const int n_sectors = lattice_.grid().n_sectors;
  const Matrix weights = block(core_.weights, position * n_sectors, 0, n_sectors, core_.weights.columns());
  return product(weights, Op::none, core_.modes, Op::none);
}

/// Polar components of v at a node of a sector, from core_values(); nothing at nodes without material.
template <int dim>
std::optional<Vec<dim>> RingDisplacement<dim>::at_node(const Matrix& core, int position, int sector,
                                                       const std::array<int, dim>& node) const {
  const PolarGrid<dim>& grid = lattice_.grid();
  const int degree = lattice_.degree(), base_row = degree * problem_.core_rows();
  Vec<dim> polar{};
  if (node[0] == 0) return polar;
  if (node[0] > base_row) {
    const int column = position * grid.ring_columns() + sector * grid.columns() + node[1] / degree;
    std::copy_n(tread_nodes_.column(column) + tread_cells_.row_of_node(node), dim, polar.begin());
    return polar;
  }
  // A node of the first azimuth may belong to the sector before alone.
  const SectorSpace<dim>& space = solution_.ring.sector().space;
  int number = space.number(node), from = sector;
  if (number < 0 && node[1] == 0) {
    auto behind = node;
    behind[1] = lattice_.nodes()[1];
    number = space.number(behind);
    from = (sector + grid.n_sectors - 1) % grid.n_sectors;
  }
  if (number < 0) return {};
  for (int c = 0; c < dim; ++c) polar[c] = core(from, solution_.ring.row(dim * number + c));
  return polar;
}

template <int dim>
RingField RingDisplacement<dim>::at_nodes(int position) const {
  constexpr double no_material = std::numeric_limits<double>::quiet_NaN();
  const PolarGrid<dim>& grid = lattice_.grid();
  const GroundPosition& ground = solution_.positions.grounds[position];
  const RimMotion& rim = solution_.states[position].rim;
  const GroundFrame lean{0, ground.camber};
  const auto of_rim_at = [&](const Vec<dim>& x) {
    if (ground.camber == 0) return wheelwright::displacement<dim>(rim, x);
    return lean.to_body<dim>(wheelwright::displacement<dim>(rim, lean.to_ground<dim>(x)));
  };
  const Matrix core = core_values(position);
  RingField field{dim, std::vector<double>(dim * size_t(lattice_.n_nodes()) * grid.n_sectors, no_material)};
  const int nodes_per_azimuth = lattice_.n_nodes() / lattice_.nodes()[1];
  for (int sector = 0; sector < grid.n_sectors; ++sector)
    for (int line = 0; line < lattice_.nodes()[1]; ++line) {
      const double azimuth = sector * grid.sector_angle() + line * lattice_.node_angle();
      const AxleRotation from_polar(azimuth), from_ground(azimuth - ground.azimuth(grid));
      for (int k = 0; k < nodes_per_azimuth; ++k) {
        const int node = line * nodes_per_azimuth + k;
        const auto place = lattice_.node_position(node);
        const auto v = at_node(core, position, sector, place);
        if (!v) continue;
        const double radius = lattice_.polar_point(place)[0];
        const Vec<dim> of_rim = from_ground.back(of_rim_at(from_ground.forward(Vec<dim>{radius})));
        Vec<dim> polar = *v;
        for (int d = 0; d < dim; ++d) polar[d] += of_rim[d];
        const Vec<dim> u = from_polar.forward(polar);
        std::copy(u.begin(), u.end(), &field.values[dim * (node + size_t(lattice_.n_nodes()) * sector)]);
      }
    }
  return field;
}

template <int dim>
Matrix RingDisplacement<dim>::cell_displacements(int cell) const {
  const PolarGrid<dim>& grid = lattice_.grid();
  const auto place = grid.cell_position(cell);
  const int n_dofs = dim * nodes_per_cell<dim>(lattice_.degree());
  if (place[0] < problem_.core_rows()) {
    Matrix modes(core_.modes.rows(), n_dofs);
    gather(solution_.ring, solution_.ring.sector().space.cell_nodes(cell), core_.modes, modes);
    return product(modes, Op::transpose, core_.weights, Op::transpose);
  }
  int axial = 0;
  if constexpr (dim == 3) axial = place[2];
  const Matrix all = tread_cells_.displacements(place[0], axial, tread_, tread_nodes_);
  Matrix result(n_dofs, solution_.positions.size() * grid.n_sectors);
  for (int j = 0; j < result.columns(); ++j) {
    const int position = j / grid.n_sectors, sector = j % grid.n_sectors;
    std::copy_n(all.column(position * grid.ring_columns() + sector * grid.columns() + place[1]), n_dofs,
                result.column(j));
  }
  return result;
}

namespace {

/// The strains at points of a cell as a linear map of its dofs, n_rows rows per point of which they are the
/// first.
template <int dim>
Matrix strain_map(const ElasticElement<dim>& element, std::span<const Vec<dim>> points, int n_rows) {
  Matrix map(n_rows * static_cast<int>(points.size()), element.n_dofs());
  for (size_t q = 0; q < points.size(); ++q) {
    const auto at = element.at(points[q]);
    for (int j = 0; j < element.n_dofs(); ++j)
      for (int k = 0; k < n_strains<dim>; ++k) map(n_rows * static_cast<int>(q) + k, j) = at.strain[k][j];
  }
  return map;
}

/// The axes in whose plane a rotation turns, from the first to the second.
template <int dim>
std::array<int, 2> plane_of_rotation(int rotation) {
  if constexpr (dim == 2) return {0, 1};
  return {(rotation + 1) % 3, (rotation + 2) % 3};
}

/// Turns the vectors whose components along two axes stand in a row and the next one, as seen in axes of that
/// azimuth.
void turn_back(double azimuth, int row, Matrix& map) {
  const AxleRotation rotation(azimuth);
  for (int j = 0; j < map.columns(); ++j) {
    double* vector = map.column(j) + row;
    const Vec<2> seen = rotation.back(Vec<2>{vector[0], vector[1]});
    std::copy(seen.begin(), seen.end(), vector);
  }
}

/// Adds the rotations to a map, from `row` of each point on, in the axes of the strains.
template <int dim>
void add_rotations(const ElasticElement<dim>& element, std::span<const Vec<dim>> points, int n_rows, int row,
                   Matrix& map) {
  for (size_t q = 0; q < points.size(); ++q) {
    const auto gradient = element.gradient(points[q]);
    for (int r = 0; r < n_rotations<dim>; ++r) {
      const auto [from, to] = plane_of_rotation<dim>(r);
      for (int j = 0; j < element.n_dofs(); ++j)
        map(n_rows * static_cast<int>(q) + row + r, j) =
            0.5 * (gradient[dim * to + from][j] - gradient[dim * from + to][j]);
    }
    if (dim == 3 && element.has_polar_strains())
      turn_back(element.azimuth_of_strains(element.at(points[q]).position),
                n_rows * static_cast<int>(q) + row, map);
  }
}

}  // namespace

template <int dim>
FactoredField RingDisplacement<dim>::strains(int cell, std::span<const Vec<dim>> points) const {
  const auto& element = problem_.elements().element(lattice_.grid().cell_position(cell)[0]);
  return {strain_map<dim>(element, points, n_strains<dim>), cell_displacements(cell)};
}

template <int dim>
FactoredField RingDisplacement<dim>::strains_and_rotations(int cell, std::span<const Vec<dim>> points) const {
  const auto& element = problem_.elements().element(lattice_.grid().cell_position(cell)[0]);
  constexpr int n_rows = n_strains<dim> + n_rotations<dim>;
  Matrix map = strain_map<dim>(element, points, n_rows);
  add_rotations<dim>(element, points, n_rows, n_strains<dim>, map);
  return {std::move(map), cell_displacements(cell)};
}

template class RingDisplacement<2>;
template class RingDisplacement<3>;

}  // namespace wheelwright
