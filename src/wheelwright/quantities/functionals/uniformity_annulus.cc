#include "wheelwright/quantities/functionals/uniformity_annulus.h"

#include "wheelwright/quantities/functionals/squared_deviation.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> UniformityAnnulus<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                      const State<dim>& state, const Matrix& mean) const {
  const TreadSurface<dim>& tread = solver.tread_surface();
  const ObservationRows<dim> rows = tread.rows();
  const double scale =
      length_ / (solver.model().materials.at_tread().scaling_modulus() * tread.annulus_thickness);
  std::vector<WeightedTraction> tractions;
  for (int q = 0; q < rows.n_annulus_points; ++q)
    tractions.push_back({rows.annulus_traction(q), scale * tread.annulus_weights[q]});
  return squared_deviation<dim>(tread, state, mean, tractions);
}

template class UniformityAnnulus<2>;
template class UniformityAnnulus<3>;

}  // namespace wheelwright
