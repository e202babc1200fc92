#include "wheelwright/state/material_integral.h"

#include "wheelwright/state/material_rule.h"

namespace wheelwright {

template <int dim>
void for_each_strain(const StateSolver<dim>& solver, const State<dim>& state,
                     const MaterialDensity<dim>& covered, const StrainVisitor<dim>& visit) {
  const RollingModel<dim>& model = solver.model();
  const Displacement<dim>& displacement = state.displacement();
  MaterialRule<dim>(state.domain(), model.degree)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        const auto place = model.grid.cell_position(cell);
        if (!covered.covers(model.grid, place[0])) return;
        const CellMap<dim> map(model.grid, model.degree, place);
        std::vector<Vec<dim>> xi;
        std::vector<double> weights;
        for (const auto& point : points) {
          xi.push_back(point.xi);
          weights.push_back(point.weight *
                            determinant<dim>(map.jacobian(ShapeFunctions<dim>(model.degree, point.xi))));
        }
        const MaterialLaw<dim>& law = model.materials.in_row(place[0]);
        for_each_strain<dim>(displacement.strains(cell, xi),
                             [&](int load_case, int q, const Voigt<dim>& strain) {
                               visit(load_case / model.grid.n_sectors, weights[q], law, strain);
                             });
      });
}

template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density) {
  std::vector<double> integrals(state.positions().size(), 0.0);
  for_each_strain<dim>(
      solver, state, density,
      [&](int position, double weight, const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
        integrals[position] += weight * density.at(strain, law).density;
      });
  return integrals;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                     \
  template void for_each_strain(const StateSolver<dim>&, const State<dim>&, const MaterialDensity<dim>&, \
                                const StrainVisitor<dim>&);                                              \
  template std::vector<double> material_integral(const StateSolver<dim>&, const State<dim>&,             \
                                                 const MaterialDensity<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
