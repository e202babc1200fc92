#include "wheelwright/mechanics/state/material_integral.h"

#include "wheelwright/base/parallel.h"

namespace wheelwright {

Matrix by_load_case(const Matrix& strains) {
  Matrix result(strains.columns(), strains.rows());
  for (int i = 0; i < strains.rows(); ++i)
    for (int j = 0; j < strains.columns(); ++j) result(j, i) = strains(i, j);
  return result;
}

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
  Matrix strains = by_load_case(displacement_.strains(cell, quadrature.points));
  return {cell,
          place,
          std::move(quadrature.points),
          std::move(quadrature.weights),
          std::move(strains),
          model_.grid.n_sectors,
          model_.materials.in_row(model_.grid, place[0])};
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
    std::vector<double> sums(integrals.size(), 0.0), values(cell.strains.rows());
    for (int q = 0; q < cell.n_points(); ++q) {
      density.densities(cell.at(q), values);
      for (size_t j = 0; j < values.size(); ++j) sums[j / cell.n_sectors] += cell.weights[q] * values[j];
    }
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
