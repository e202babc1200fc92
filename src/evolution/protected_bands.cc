#include "evolution/protected_bands.h"

namespace wheelwright {

template <int dim>
ProtectedBands<dim>::ProtectedBands(const Lattice<dim>& lattice, double rim_band, double tread_band)
    : nodes_(lattice.n_nodes()), upper_bound_(lattice.n_nodes()) {
  const auto& grid = lattice.grid();
  const double rounding = 1e-9 * grid.resolution();
  const double margin = 0.1 * grid.resolution();
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const double radius = lattice.polar_point(node)[0];
    const double distance =
        std::min(radius - (grid.inner_radius + rim_band), (grid.outer_radius - tread_band) - radius);
    nodes_[node] = distance < -rounding;
    upper_bound_[node] = distance - margin;
  }
}

template <int dim>
LevelSet<dim> ProtectedBands<dim>::keep(LevelSet<dim> psi) const {
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::min(psi.values[node], upper_bound_[node]);
  return psi;
}

template class ProtectedBands<2>;
template class ProtectedBands<3>;

}  // namespace wheelwright
