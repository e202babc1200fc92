#include "wheelwright/evolution/redistance.h"

#include "wheelwright/evolution/closest_point.h"
#include "wheelwright/evolution/seeds.h"
#include "wheelwright/geometry/nearest_point.h"

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

}  // namespace

template <int dim>
std::vector<Vec<dim>> closest_points(const LevelSet<dim>& psi) {
  const auto& lattice = psi.lattice;
  const CubicInterpolant<dim> interpolant(psi);
  const auto seeds = with_images<dim>(lattice, zero_seeds<dim>(interpolant));
  if (seeds.empty()) return {};
  std::vector<Vec<dim>> positions, result;
  for (const auto& seed : seeds) positions.push_back(cartesian_position<dim>(lattice, seed));
  const NearestPoint<dim> nearest_seed(std::move(positions));
  for (int n = 0; n < lattice.n_nodes(); ++n) {
    const Vec<dim> node = point_of(lattice, n);
    const Vec<dim> seed = seeds[nearest_seed.index_of_nearest(cartesian_position<dim>(lattice, node))];
    result.push_back(closest_zero<dim>(interpolant, node, seed).value_or(seed));
  }
  return result;
}

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

template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi) {
  return signed_distances<dim>(psi, closest_points(psi));
}

template decltype(closest_points<2>) closest_points<2>;
template decltype(closest_points<3>) closest_points<3>;
template decltype(signed_distances<2>) signed_distances<2>;
template decltype(signed_distances<3>) signed_distances<3>;
template decltype(redistance<2>) redistance<2>;
template decltype(redistance<3>) redistance<3>;

}  // namespace wheelwright
