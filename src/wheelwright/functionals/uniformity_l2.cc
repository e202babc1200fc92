#include "wheelwright/functionals/uniformity_l2.h"

#include "wheelwright/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> UniformityL2<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix& mean) const {
  const TreadSurface<dim>& tread = solver.tread_surface();
  const ObservationRows<dim> rows = tread.rows();
  const Matrix deviation = deviation_from_mean(tread, state.positions(), state.observations(), mean);
  const double scale = length_ / solver.model().materials.at_tread().scaling_modulus();
  FunctionalValue<dim> value{.by_position = std::vector<double>(state.positions().size()),
                             .derivative = {.tread_loads = Matrix(deviation.rows(), deviation.columns())},
                             .compares_with_mean = true};
  for (int j = 0; j < deviation.columns(); ++j) {
    const double* observed = deviation.column(j);
    double* load = value.derivative.tread_loads.column(j);
    for (int q = 0; q < rows.n_points; ++q)
      for (int row = rows.traction(q); row < rows.traction(q) + dim; ++row) {
        const double weight = scale * tread.points[q].weight;
        value.by_position[j / tread.n_columns] += 0.5 * weight * observed[row] * observed[row];
        load[row] = -weight * observed[row];
      }
  }
  return value;
}

template class UniformityL2<2>;
template class UniformityL2<3>;

}  // namespace wheelwright
