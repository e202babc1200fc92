#include "wheelwright/quantities/functionals/uniformity_dual.h"

#include "wheelwright/quantities/functionals/mean_contact_stress.h"

namespace wheelwright {

template <int dim>
Matrix traction_deviation(const TreadSurface<dim>& tread, const State<dim>& state, const Matrix& mean) {
  const ObservationRows<dim> rows = tread.rows();
  const Matrix deviation = deviation_from_mean(tread, state.positions(), state.observations(), mean);
  Matrix tractions(dim * rows.n_points, deviation.columns());
  for (int j = 0; j < tractions.columns(); ++j)
    for (int q = 0; q < rows.n_points; ++q)
      std::copy_n(deviation.column(j) + rows.traction(q), dim, tractions.column(j) + dim * q);
  return tractions;
}

template <int dim>
FunctionalValue<dim> UniformityDual<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                   const State<dim>& state, const Matrix& mean) const {
  const TreadSurface<dim>& tread = solver.tread_surface();
  const ObservationRows<dim> rows = tread.rows();
  const Matrix tractions = traction_deviation(tread, state, mean);
  const Matrix image = neumann_to_dirichlet_(tractions);
  FunctionalValue<dim> value{
      .by_position = std::vector<double>(state.positions().size()),
      .derivative = {.energy = {}, .tread_loads = Matrix(rows.size(), tractions.columns()), .integrals = {}},
      .compares_with_mean = true};
  for (int j = 0; j < tractions.columns(); ++j)
    for (int q = 0; q < rows.n_points; ++q)
      for (int d = 0; d < dim; ++d) {
        const double weight = tread.points[q].weight, w = image(dim * q + d, j);
        value.by_position[j / tread.n_columns] += 0.5 * weight * tractions(dim * q + d, j) * w;
        value.derivative.tread_loads(rows.traction(q) + d, j) = -weight * w;  // (72)
      }
  return value;
}

template class UniformityDual<2>;
template class UniformityDual<3>;
template decltype(traction_deviation<2>) traction_deviation<2>;
template decltype(traction_deviation<3>) traction_deviation<3>;

}  // namespace wheelwright
