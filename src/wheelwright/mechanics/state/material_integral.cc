#include "wheelwright/mechanics/state/material_integral.h"

#include "wheelwright/base/parallel.h"

namespace wheelwright {

template <int dim>
StrainedCells<dim>::StrainedCells(const StateSolver<dim>& solver, const State<dim>& state,
                                  const MaterialDensity<dim>& covered)
    : model_(solver.model()),
      displacement_(state.displacement()),
      rule_(state.domain(), model_.degree + 2),
      cells_(rule_.cells()) {
  std::erase_if(cells_, [&](const auto& cell) {
    return !covered.covers(model_.grid, model_.grid.cell_position(cell.cell)[0]);
  });
}

template <int dim>
StrainedCell<dim> StrainedCells<dim>::operator[](int k) const {
  const auto& [cell, points] = cells_[k];
  const auto place = model_.grid.cell_position(cell);
  auto quadrature = weighted_points(model_.grid, model_.degree, cell, points);
  FactoredField strains = displacement_.strains(cell, quadrature.points);
  return {{std::move(strains), model_.grid.n_sectors, model_.materials.in_row(model_.grid, place[0]), place,
           std::move(quadrature.points)},
          cell,
          std::move(quadrature.weights)};
}

template <int dim>
void for_each_cell(const StateSolver<dim>& solver, const State<dim>& state,
                   const MaterialDensity<dim>& covered,
                   const std::function<void(const StrainedCell<dim>&)>& visit) {
  const StrainedCells<dim> cells(solver, state, covered);
  for (int k = 0; k < cells.size(); ++k) visit(cells[k]);
}

template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density) {
  const StrainedCells<dim> cells(solver, state, density);
  std::vector<double> integrals(state.positions().size(), 0.0);
  const auto of_cell = [&](int k) {
    const StrainedCell<dim> cell = cells[k];
    const Matrix values = density.densities(cell);
    std::vector<double> sums(integrals.size(), 0.0);
    for (int q = 0; q < values.columns(); ++q)
      for (int j = 0; j < values.rows(); ++j) sums[j / cell.n_sectors()] += cell.weights[q] * values(j, q);
    return sums;
  };
  compute_in_parallel(cells.size(), of_cell, [&](int, const std::vector<double>& sums) {
    for (size_t i = 0; i < sums.size(); ++i) integrals[i] += sums[i];
  });
  return integrals;
}

template class StrainedCells<2>;
template class StrainedCells<3>;
template decltype(for_each_cell<2>) for_each_cell<2>;
template decltype(material_integral<2>) material_integral<2>;
template decltype(for_each_cell<3>) for_each_cell<3>;
template decltype(material_integral<3>) material_integral<3>;

}  // namespace wheelwright
