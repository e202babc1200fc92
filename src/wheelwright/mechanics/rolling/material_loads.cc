#include "wheelwright/mechanics/rolling/material_loads.h"

#include <algorithm>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/rolling/ring_displacement.h"
#include "wheelwright/mechanics/rolling/tread_cells.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {
namespace {

/// The loads on one cell's dofs, one row per load case; empty if there are none.
template <int dim>
Matrix cell_loads(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                  const std::array<int, dim>& place, const Matrix& strains,
                  std::span<const ReferencePoint<dim>> points, int n_sectors,
                  std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  const int n_cases = strains.columns(), n_points = static_cast<int>(points.size());
  const Matrix of_cases = by_load_case(strains);
  Matrix stresses(n_cases, n_strains<dim> * n_points), slopes(n_cases, n_strains<dim>);
  bool is_zero = true;
  for (const auto& [density, factors] : integrals) {
    std::vector<double> of_case(n_cases);
    for (int load_case = 0; load_case < n_cases; ++load_case)
      of_case[load_case] = factors[load_case / n_sectors];
    for (int q = 0; q < n_points; ++q) {
      density->slopes(
          {strain_columns<dim>(of_cases, n_strains<dim> * q), n_sectors, law, place, points[q].xi}, of_case,
          stress_columns<dim>(slopes, 0));
      double* sum = stresses.column(n_strains<dim> * q);
      for (size_t i = 0; i < slopes.entries().size(); ++i) {
        sum[i] += slopes.data()[i];
        is_zero = is_zero && slopes.data()[i] == 0;
      }
    }
  }
  if (is_zero) return {};
  Matrix maps(n_strains<dim> * n_points, element.n_dofs());
  for (int q = 0; q < n_points; ++q) {
    const auto at = element.at(points[q].xi);
    const double weight = -points[q].weight * at.determinant;
    for (int dof = 0; dof < element.n_dofs(); ++dof)
      for (int k = 0; k < n_strains<dim>; ++k) maps(n_strains<dim> * q + k, dof) = weight * at.strain[k][dof];
  }
  return product(stresses, Op::none, maps, Op::none);
}

/// Adds a cell's loads to those of the core.
template <int dim>
void add_to_core(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& loads,
                 Matrix& core) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim && nodes[a] >= 0; ++c) {
      const double* from = loads.column(dim * static_cast<int>(a) + c);
      double* to = core.column(ring.row(dim * nodes[a] + c));
      for (int j = 0; j < core.rows(); ++j) to[j] += from[j];
    }
}

/// Loads of one cell of the sector, by load cases, as loads of a ring column's cells: one row per dof, one
/// column per field of the tread.
template <int dim>
Matrix by_ring_columns(const Matrix& loads, const PolarGrid<dim>& grid, int column) {
  const int n_positions = loads.rows() / grid.n_sectors;
  Matrix result(loads.columns(), n_positions * grid.ring_columns());
  for (int j = 0; j < loads.rows(); ++j) {
    const int position = j / grid.n_sectors, sector = j % grid.n_sectors;
    double* to = result.column(position * grid.ring_columns() + sector * grid.columns() + column);
    for (int dof = 0; dof < loads.columns(); ++dof) to[dof] = loads(j, dof);
  }
  return result;
}

}  // namespace

template <int dim>
MaterialLoads material_loads(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                             std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  const PolarGrid<dim>& grid = problem.model().grid;
  const RingDisplacement<dim> displacement(problem, s);
  const TreadCells<dim> tread(problem.tread(), grid, problem.model().degree);
  const int n_positions = s.positions.size();
  MaterialLoads loads{Matrix(n_positions * grid.n_sectors, s.ring.sector_factor().size()),
                      tread.no_forces(n_positions * grid.ring_columns())};
  const MaterialRule<dim> rule(s.domain, problem.model().degree + 2);
  const auto cells = rule.cells();
  const auto of_cell = [&](int k) {
    const auto& [cell, points] = cells[k];
    const auto place = grid.cell_position(cell);
    const auto covering = integrals_in_row<dim>(integrals, grid, place[0]);
    if (covering.empty()) return Matrix();
    std::vector<Vec<dim>> xi;
    for (const auto& point : points) xi.push_back(point.xi);
    return cell_loads<dim>(problem.elements().element(place[0]), problem.elements().law(place[0]), place,
                           displacement.strains(cell, xi), points, grid.n_sectors, covering);
  };
  compute_in_parallel(static_cast<int>(cells.size()), of_cell, [&](int k, const Matrix& of_dofs) {
    if (of_dofs.entries().empty()) return;
    const int cell = cells[k].cell;
    const auto place = grid.cell_position(cell);
    if (place[0] < problem.core_rows()) {
      add_to_core(s.ring, s.ring.sector().space.cell_nodes(cell), of_dofs, loads.core);
    } else {
      int axial = 0;
      if constexpr (dim == 3) axial = place[2];
      tread.add_loads(place[0], axial, by_ring_columns<dim>(of_dofs, grid, place[1]), loads.tread);
    }
  });
  return loads;
}

template decltype(material_loads<2>) material_loads<2>;
template decltype(material_loads<3>) material_loads<3>;

}  // namespace wheelwright
