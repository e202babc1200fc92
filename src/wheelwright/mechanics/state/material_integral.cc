#include "wheelwright/mechanics/state/material_integral.h"

#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {

Matrix by_load_case(const Matrix& strains) {
  Matrix result(strains.columns(), strains.rows());
  for (int i = 0; i < strains.rows(); ++i)
    for (int j = 0; j < strains.columns(); ++j) result(j, i) = strains(i, j);
  return result;
}

template <int dim>
void for_each_cell(const StateSolver<dim>& solver, const State<dim>& state,
                   const MaterialDensity<dim>& covered,
                   const std::function<void(const StrainedCell<dim>&)>& visit) {
  const RollingModel<dim>& model = solver.model();
  const Displacement<dim>& displacement = state.displacement();
  MaterialRule<dim>(state.domain(), model.degree + 2)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        const auto place = model.grid.cell_position(cell);
        if (!covered.covers(model.grid, place[0])) return;
        auto quadrature = weighted_points(model.grid, model.degree, cell, points);
        Matrix strains = by_load_case(displacement.strains(cell, quadrature.points));
        visit({cell, std::move(quadrature.points), std::move(quadrature.weights), std::move(strains),
               model.grid.n_sectors, model.materials.in_row(model.grid, place[0])});
      });
}

template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density) {
  std::vector<double> integrals(state.positions().size(), 0.0);
  for_each_cell<dim>(solver, state, density, [&](const StrainedCell<dim>& cell) {
    Matrix values(cell.strains.rows(), cell.n_points());
    for (int q = 0; q < cell.n_points(); ++q)
      density.densities(cell.at(q), {values.column(q), static_cast<size_t>(values.rows())});
    for (int j = 0; j < values.rows(); ++j)
      for (int q = 0; q < cell.n_points(); ++q)
        integrals[j / cell.n_sectors] += cell.weights[q] * values(j, q);
  });
  return integrals;
}

template decltype(for_each_cell<2>) for_each_cell<2>;
template decltype(material_integral<2>) material_integral<2>;
template decltype(for_each_cell<3>) for_each_cell<3>;
template decltype(material_integral<3>) material_integral<3>;

}  // namespace wheelwright
