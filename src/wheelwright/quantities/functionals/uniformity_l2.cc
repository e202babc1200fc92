#include "wheelwright/quantities/functionals/uniformity_l2.h"

#include "wheelwright/quantities/functionals/squared_deviation.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> UniformityL2<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix& mean) const {
  const TreadSurface<dim>& tread = solver.tread_surface();
  const ObservationRows<dim> rows = tread.rows();
  const double scale = length_ / solver.model().materials.at_tread().scaling_modulus();
  std::vector<WeightedTraction> tractions;
  for (int q = 0; q < rows.n_points; ++q)
    tractions.push_back({rows.traction(q), scale * tread.points[q].weight});
  return squared_deviation<dim>(tread, state, mean, tractions);
}

template class UniformityL2<2>;
template class UniformityL2<3>;

}  // namespace wheelwright
