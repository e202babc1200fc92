#include "evolution/protected_bands.h"

namespace wheelwright {

namespace {

constexpr double margin = 0.1;  ///< of the resolution

}  // namespace

template <int dim>
ProtectedBands<dim>::ProtectedBands(const Lattice<dim>& lattice, double rim_band, double tread_band)
    : grid_(lattice.grid()),
      inner_edge_(grid_.inner_radius + rim_band),
      outer_edge_(grid_.outer_radius - tread_band),
      nodes_(lattice.n_nodes()),
      upper_bound_(lattice.n_nodes()) {
  const double h = grid_.resolution(), rounding = 1e-9 * h;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const double d = distance(lattice.polar_point(node)[0]);
    nodes_[node] = d < -rounding;
    upper_bound_[node] = d - margin * h;
  }
}

/// To the nearest band; negative in a band.
template <int dim>
double ProtectedBands<dim>::distance(double radius) const {
  return std::min(radius - inner_edge_, outer_edge_ - radius);
}

template <int dim>
bool ProtectedBands<dim>::touches(const SurfaceSample<dim>& sample) const {
  const double radius =
      grid_.inner_radius + (grid_.cell_position(sample.cell)[0] + sample.xi[0]) * grid_.cell_size()[0];
  return distance(radius) < 2 * margin * grid_.resolution();
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
