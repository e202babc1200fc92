#include "wheelwright/state/material_integral.h"

#include "wheelwright/state/material_rule.h"

namespace wheelwright {

template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density) {
  const RollingModel<dim>& model = solver.model();
  const auto displacement = state.displacement();
  std::vector<double> integrals(state.positions().size(), 0.0);
  MaterialRule<dim>(state.domain(), model.degree)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        const auto place = model.grid.cell_position(cell);
        const CellMap<dim> map(model.grid, model.degree, place);
        std::vector<Vec<dim>> xi;
        std::vector<double> weights;
        for (const auto& point : points) {
          xi.push_back(point.xi);
          weights.push_back(point.weight *
                            determinant<dim>(map.jacobian(ShapeFunctions<dim>(model.degree, point.xi))));
        }
        const Material& material = model.materials.in_row(place[0]);
        for_each_strain<dim>(displacement->strains(cell, xi), [&](int load_case, int q,
                                                                  const Voigt<dim>& strain) {
          integrals[load_case / model.grid.n_sectors] += weights[q] * density.at(strain, material).density;
        });
      });
  return integrals;
}

template std::vector<double> material_integral(const StateSolver<2>&, const State<2>&,
                                               const MaterialDensity<2>&);
template std::vector<double> material_integral(const StateSolver<3>&, const State<3>&,
                                               const MaterialDensity<3>&);

}  // namespace wheelwright
