#include "wheelwright/mechanics/rolling/distributed_loads.h"

namespace wheelwright {
namespace {

/// Integrals over one sector, its tread left out, in the sector's frame: the Cartesian axes, the first radial
/// at azimuth 0.
template <int dim>
struct SectorIntegrals {
  /// int phi.e_k dx, one row an axis k; int_Gamma_m -phi.n dS; of wheels that rotate last int density phi.x
  /// dx, x in the wheel's plane; in elimination order
  Matrix loads;
  double volume = 0;
  Vec<dim> moment{};          ///< int x dx
  Vec<dim> mass_moment{};     ///< int density x dx
  RimForce pressure_force{};  ///< int_Gamma_m -n dS and its moment about the axle
};

/// Integrals of the displacement, 1 and x over one cell, in its frame.
template <int dim>
struct CellIntegrals {
  using Row = std::array<double, ElasticElement<dim>::max_dofs>;
  std::array<Row, dim> displacement{};
  Row spin{};  ///< of phi.x, x in the wheel's plane
  double volume = 0;
  Vec<dim> moment{};
};

template <int dim>
CellIntegrals<dim> integrate(const ElasticElement<dim>& element,
                             std::span<const ReferencePoint<dim>> points) {
  CellIntegrals<dim> result;
  for (const auto& q : points) {
    const auto at = element.at(q.xi);
    const double weight = q.weight * at.determinant;
    result.volume += weight;
    for (int d = 0; d < dim; ++d) {
      result.moment[d] += weight * at.position[d];
      for (int i = 0; i < element.n_dofs(); ++i) result.displacement[d][i] += weight * at.displacement[d][i];
      if (d < 2)
        for (int i = 0; i < element.n_dofs(); ++i)
          result.spin[i] += weight * at.position[d] * at.displacement[d][i];
    }
  }
  return result;
}

/// Adds rows[d][dof] of a cell's dofs, d an axis of the cell's frame, against the vector `along`.
template <int dim, class Rows>
void add_load(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Rows& rows,
              const Vec<dim>& along, int load, Matrix& loads) {
  for (size_t a = 0; a < nodes.size(); ++a) {
    if (nodes[a] < 0) continue;
    for (int c = 0; c < dim; ++c)
      for (int d = 0; d < dim; ++d)
        loads(load, ring.row(dim * nodes[a] + c)) += rows[d][dim * a + c] * along[d];
  }
}

/// Adds row[dof] of a cell's dofs.
template <int dim, class Row>
void add_number(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Row& row, double factor,
                int load, Matrix& loads) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim && nodes[a] >= 0; ++c)
      loads(load, ring.row(dim * nodes[a] + c)) += factor * row[dim * a + c];
}

template <int dim>
SectorIntegrals<dim> sector_integrals(const CutDomain<dim>& domain, const ElementTable<dim>& elements,
                                      const CyclicStiffness<dim>& ring, bool rotates) {
  const PolarGrid<dim>& grid = domain.grid;
  const SectorSpace<dim>& space = ring.sector().space;
  SectorIntegrals<dim> sector{Matrix(dim + (rotates ? 2 : 1), ring.sector_factor().size())};
  const auto add_cell = [&](int cell, const CellIntegrals<dim>& integrals) {
    const double angle = grid.cell_position(cell)[1] * grid.column_angle();
    const auto nodes = space.cell_nodes(cell);
    for (int k = 0; k < dim; ++k) {
      Vec<dim> axis{};
      axis[k] = 1;
      add_load<dim>(ring, nodes, integrals.displacement, rotated<dim>(axis, -angle), k, sector.loads);
    }
    sector.volume += integrals.volume;
    const Vec<dim> moment = rotated<dim>(integrals.moment, angle);
    for (int d = 0; d < dim; ++d) sector.moment[d] += moment[d];
    if (!rotates) return;
    const double density = elements.law(grid.cell_position(cell)[0]).density().value_or(0);
    add_number<dim>(ring, nodes, integrals.spin, density, dim + 1, sector.loads);
    for (int d = 0; d < 2; ++d) sector.mass_moment[d] += density * moment[d];
  };

  const auto rule = unit_cell_rule<dim>(elements.degree() + 2);
  for (int radial = 0; radial < space.core_rows(); ++radial) {
    const auto full = integrate<dim>(elements.element(radial), rule);
    for (int cell = 0; cell < grid.n_cells(); ++cell)
      if (domain.kinds[cell] == CellKind::inside && grid.cell_position(cell)[0] == radial)
        add_cell(cell, full);
  }
  for (const CutCell<dim>& cut : domain.cut) {
    const auto position = grid.cell_position(cut.cell);
    const auto& element = elements.element(position[0]);
    add_cell(cut.cell, integrate<dim>(element, cut.material));
    const auto nodes = space.cell_nodes(cut.cell);
    for (const auto& q : cut.boundary) {
      const auto at = element.at(q.xi);
      const auto surface = map_surface<dim>(at.jacobian, q.normal);
      Vec<dim> force = surface.normal;
      for (double& x : force) x *= -q.weight * surface.scale;
      add_load<dim>(ring, nodes, at.displacement, force, dim, sector.loads);
      const double angle = position[1] * grid.column_angle();
      sector.pressure_force = sum(sector.pressure_force, resultant<dim>(rotated<dim>(force, angle),
                                                                        rotated<dim>(at.position, angle)));
    }
  }
  return sector;
}

/// A force given in one frame, in the frame turned by an angle.
template <int dim>
RimForce turned(const RimForce& force, double angle) {
  const Vec<2> v = rotated<2>({force.towards_ground, force.along_ground}, angle);
  return {v[0], v[1], force.torque, force.along_axle};
}

/// The work of a body force on the rim's motions: `moment` is int x dx in the ground frame.
template <int dim>
RimForce body_resultant(const Vec<dim>& force, double volume, const Vec<dim>& moment) {
  return {volume * force[0], volume * force[1], moment[0] * force[1] - moment[1] * force[0],
          dim == 3 ? volume * force[dim - 1] : 0};
}

}  // namespace

template <int dim>
AppliedLoads applied_loads(const DistributedLoads<dim>& loads, const CutDomain<dim>& domain,
                           const ElementTable<dim>& elements, const CyclicStiffness<dim>& ring,
                           const Tread<dim>& tread, std::span<const GroundPosition> grounds) {
  AppliedLoads applied{{}, {}, std::vector<RimForce>(grounds.size())};
  if (!loads.any()) return applied;
  const PolarGrid<dim>& grid = domain.grid;
  const bool rotates = loads.angular_speed != 0;
  const double pull = loads.angular_speed * loads.angular_speed;
  SectorIntegrals<dim> sector = sector_integrals(domain, elements, ring, rotates);
  const int n_positions = static_cast<int>(grounds.size()), n_columns = tread.n_columns();
  const int n_loads = sector.loads.rows();
  applied.core = {std::move(sector.loads), Matrix(n_positions * grid.n_sectors, n_loads)};
  applied.tread = Matrix(tread.n_observations(), n_positions * n_columns);
  for (int i = 0; i < n_positions; ++i) {
    const double ground = grounds[i].azimuth(grid);
    RimForce& on_the_rim = applied.on_the_rim[i];
    for (int s = 0; s < grid.n_sectors; ++s) {
      const double to_sector = ground - s * grid.sector_angle();
      const Vec<dim> force = rotated<dim>(loads.body_force, to_sector);
      for (int k = 0; k < dim; ++k) applied.core.weights(i * grid.n_sectors + s, k) = force[k];
      applied.core.weights(i * grid.n_sectors + s, dim) = loads.hole_pressure;
      if (rotates) {
        applied.core.weights(i * grid.n_sectors + s, dim + 1) = pull;
        const Vec<dim> moment = rotated<dim>(sector.mass_moment, -to_sector);
        on_the_rim = sum(on_the_rim, {pull * moment[0], pull * moment[1], 0, 0});
      }
      on_the_rim = sum(on_the_rim, body_resultant<dim>(loads.body_force, sector.volume,
                                                       rotated<dim>(sector.moment, -to_sector)));
      on_the_rim =
          sum(on_the_rim, scaled(loads.hole_pressure, turned<dim>(sector.pressure_force, -to_sector)));
    }
    for (int c = 0; c < n_columns; ++c) {
      const double to_column = ground - c * grid.column_angle();
      const Vec<dim> force = rotated<dim>(loads.body_force, to_column);
      for (int d = 0; d < dim; ++d)
        applied.tread(tread.observation_rows().integral() + d, i * n_columns + c) = force[d];
      if (rotates) applied.tread(tread.observation_rows().spin(), i * n_columns + c) = pull;
      on_the_rim = sum(on_the_rim, body_resultant<dim>(loads.body_force, tread.column().volume,
                                                       rotated<dim>(tread.column().moment, -to_column)));
    }
  }
  return applied;
}

template decltype(applied_loads<2>) applied_loads<2>;
template decltype(applied_loads<3>) applied_loads<3>;

}  // namespace wheelwright
