#include "wheelwright/evolution/spline_redistance.h"

#include "wheelwright/evolution/cubic_interpolant.h"
#include "wheelwright/evolution/redistance.h"
#include "wheelwright/evolution/spline_level_set.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> redistanced_coefficients(const LevelSet<dim>& psi) {
  constexpr int corrections = 4;
  const auto closest = closest_points(psi);
  LevelSet<dim> coefficients = spline_coefficients(signed_distances<dim>(psi, closest));
  if (psi.lattice.degree() == 1) return coefficients;
  for (int k = 0; k < corrections && !closest.empty(); ++k) {
    const LevelSet<dim> shape = spline_level_set(coefficients);
    const CubicInterpolant<dim> value(shape);
    for (std::size_t node = 0; node < closest.size(); ++node)
      coefficients.values[node] -= value(closest[node]).value;
  }
  return coefficients;
}

template decltype(redistanced_coefficients<2>) redistanced_coefficients<2>;
template decltype(redistanced_coefficients<3>) redistanced_coefficients<3>;

}  // namespace wheelwright
