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
Matrix cell_loads(const StrainsInCell<dim>& strains, std::span<const double> weights,
                  std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  Matrix stresses = sum_of_slopes<dim>(integrals, strains);
  if (std::ranges::all_of(stresses.entries(), [](double entry) { return entry == 0; })) return {};
  for (int j = 0; j < stresses.columns(); ++j)
    for (int i = 0; i < stresses.rows(); ++i) stresses(i, j) *= -weights[j / n_strains<dim>];
  return product(stresses, Op::none, strains.map(), Op::none);
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
    auto [xi, weights] = weighted_points(grid, problem.model().degree, cell, points);
    FactoredField strains = displacement.strains(cell, xi);
    return cell_loads<dim>({std::move(strains), grid.n_sectors, problem.elements().law(place[0]), place, xi},
                           weights, covering);
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
