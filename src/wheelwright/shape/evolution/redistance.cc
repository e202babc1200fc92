#include "wheelwright/shape/evolution/redistance.h"

#include "wheelwright/shape/evolution/closest_point.h"
#include "wheelwright/shape/evolution/cubic_interpolant.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/geometry/nearest_point.h"

namespace wheelwright {
namespace {

/// A node in units of the node spacing.
template <int dim>
Vec<dim> point_of(const Lattice<dim>& lattice, int node) {
  const auto position = lattice.node_position(node);
  Vec<dim> point;
  for (int d = 0; d < dim; ++d) point[d] = position[d];
  return point;
}

/// The points of {psi = 0} that are closest to the nodes, one for each, in units of the node spacing of the
/// lattice. They may lie in the neighbouring sectors. Empty where psi has one sign.
template <int dim>
std::vector<Vec<dim>> closest_points(const LevelSet<dim>& psi) {
  const auto& lattice = psi.lattice;
  const CubicInterpolant<dim> interpolant(psi);
  const auto seeds = with_images<dim>(lattice, zero_seeds<dim>(interpolant));
  if (seeds.empty()) return {};
  std::vector<Vec<dim>> positions, result;
  for (const auto& seed : seeds) positions.push_back(cartesian_position<dim>(lattice, seed));
  const NearestPoint<dim> nearest_seed(std::move(positions));
  result.reserve(lattice.n_nodes());
  int nearest = 0;  // to the node before, too, if that is a neighbour
  for (int n = 0; n < lattice.n_nodes(); ++n) {
    const Vec<dim> node = point_of(lattice, n);
    nearest = nearest_seed.index_of_nearest(cartesian_position<dim>(lattice, node), nearest);
    const Vec<dim> seed = seeds[nearest];
    result.push_back(closest_zero<dim>(interpolant, node, seed).value_or(seed));
  }
  return result;
}

/// The distances of the nodes from these points, with the signs of psi; psi itself where there are none.
template <int dim>
LevelSet<dim> signed_distances(const LevelSet<dim>& psi, const std::vector<Vec<dim>>& closest) {
  LevelSet<dim> result = psi;
  for (std::size_t n = 0; n < closest.size(); ++n) {
    const double distance =
        physical_distance<dim>(psi.lattice, point_of(psi.lattice, static_cast<int>(n)), closest[n]);
    result.values[n] = psi.values[n] < 0 ? -distance : distance;
  }
  return result;
}

}  // namespace

template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi) {
  return signed_distances<dim>(psi, closest_points(psi));
}

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

template decltype(redistance<2>) redistance<2>;
template decltype(redistance<3>) redistance<3>;
template decltype(redistanced_coefficients<2>) redistanced_coefficients<2>;
template decltype(redistanced_coefficients<3>) redistanced_coefficients<3>;

}  // namespace wheelwright
