#include "wheelwright/mechanics/rolling/material_loads.h"

#include <algorithm>

#include "wheelwright/mechanics/rolling/ring_displacement.h"
#include "wheelwright/mechanics/rolling/tread_cells.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {
namespace {

/// The loads on one cell's dofs, one column per load case.
template <int dim>
Matrix cell_loads(const ElasticElement<dim>& element, const MaterialLaw<dim>& law, const Matrix& strains,
                  std::span<const ReferencePoint<dim>> points, int n_sectors,
                  std::span<const typename FunctionalDerivative<dim>::Integral> integrals) {
  std::vector<typename ElasticElement<dim>::Point> at;
  for (const auto& point : points) at.push_back(element.at(point.xi));
  const int n_cases = strains.columns();
  const Matrix of_cases = by_load_case(strains);
  Matrix loads(element.n_dofs(), n_cases), stress(n_cases, n_strains<dim>), slopes = stress;
  for (int q = 0; q < static_cast<int>(points.size()); ++q) {
    std::ranges::fill(stress.entries(), 0.0);
    for (const auto& [density, factors] : integrals) {
      std::vector<double> of_case;
      for (int load_case = 0; load_case < n_cases; ++load_case)
        of_case.push_back(factors[load_case / n_sectors]);
      density->slopes({strain_columns<dim>(of_cases, n_strains<dim> * q), n_sectors, law}, of_case,
                      stress_columns<dim>(slopes, 0));
      for (size_t i = 0; i < stress.entries().size(); ++i) stress.data()[i] += slopes.data()[i];
    }
    const double weight = points[q].weight * at[q].determinant;
    for (int load_case = 0; load_case < n_cases; ++load_case)
      for (int k = 0; k < n_strains<dim>; ++k)
        for (int dof = 0; dof < element.n_dofs(); ++dof)
          loads(dof, load_case) -= weight * stress(load_case, k) * at[q].strain[k][dof];
  }
  return loads;
}

/// Adds a cell's loads to those of the core.
template <int dim>
void add_to_core(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& loads,
                 Matrix& core) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim && nodes[a] >= 0; ++c) {
      double* to = core.column(ring.row(dim * nodes[a] + c));
      for (int j = 0; j < core.rows(); ++j) to[j] += loads(dim * static_cast<int>(a) + c, j);
    }
}

/// Loads of one cell of the sector, by load cases, as loads of a ring column's cells, by fields of the tread.
template <int dim>
Matrix by_ring_columns(const Matrix& loads, const PolarGrid<dim>& grid, int column) {
  const int n_positions = loads.columns() / grid.n_sectors;
  Matrix result(loads.rows(), n_positions * grid.ring_columns());
  for (int j = 0; j < loads.columns(); ++j) {
    const int position = j / grid.n_sectors, sector = j % grid.n_sectors;
    std::copy_n(loads.column(j), loads.rows(),
                result.column(position * grid.ring_columns() + sector * grid.columns() + column));
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
  MaterialRule<dim>(s.domain, problem.model().degree + 2)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        const auto place = grid.cell_position(cell);
        const auto covering = integrals_in_row<dim>(integrals, grid, place[0]);
        if (covering.empty()) return;
        std::vector<Vec<dim>> xi;
        for (const auto& point : points) xi.push_back(point.xi);
        const Matrix of_cell =
            cell_loads<dim>(problem.elements().element(place[0]), problem.elements().law(place[0]),
                            displacement.strains(cell, xi), points, grid.n_sectors, covering);
        if (place[0] < problem.core_rows()) {
          add_to_core(s.ring, s.ring.sector().space.cell_nodes(cell), of_cell, loads.core);
        } else {
          int axial = 0;
          if constexpr (dim == 3) axial = place[2];
          tread.add_loads(place[0], axial, by_ring_columns<dim>(of_cell, grid, place[1]), loads.tread);
        }
      });
  return loads;
}

template decltype(material_loads<2>) material_loads<2>;
template decltype(material_loads<3>) material_loads<3>;

}  // namespace wheelwright
