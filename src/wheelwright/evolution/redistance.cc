#include "wheelwright/evolution/redistance.h"

#include "wheelwright/evolution/closest_point.h"
#include "wheelwright/evolution/seeds.h"
#include "wheelwright/geometry/nearest_point.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> redistance(const LevelSet<dim>& psi) {
  const auto& lattice = psi.lattice;
  const CubicInterpolant<dim> interpolant(psi);
  const auto seeds = with_images<dim>(lattice, zero_seeds<dim>(interpolant));
  if (seeds.empty()) return psi;
  std::vector<Vec<dim>> positions;
  for (const auto& seed : seeds) positions.push_back(cartesian_position<dim>(lattice, seed));
  const NearestPoint<dim> nearest_seed(std::move(positions));
  LevelSet<dim> result = psi;
  for (int n = 0; n < lattice.n_nodes(); ++n) {
    const auto position = lattice.node_position(n);
    Vec<dim> node;
    for (int d = 0; d < dim; ++d) node[d] = position[d];
    const Vec<dim> seed = seeds[nearest_seed.index_of_nearest(cartesian_position<dim>(lattice, node))];
    const Vec<dim> closest = closest_zero<dim>(interpolant, node, seed).value_or(seed);
    const double distance = physical_distance<dim>(lattice, node, closest);
    result.values[n] = psi.values[n] < 0 ? -distance : distance;
  }
  return result;
}

template LevelSet<2> redistance<2>(const LevelSet<2>&);
template LevelSet<3> redistance<3>(const LevelSet<3>&);

}  // namespace wheelwright
