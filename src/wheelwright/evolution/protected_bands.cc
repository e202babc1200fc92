#include "wheelwright/evolution/protected_bands.h"

namespace wheelwright {

namespace {

constexpr double margin = 0.1;  ///< in units of the resolution

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

/// Radial distance to the nearest band; negative in a band.
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

template <int dim>
std::vector<ShapeEvent<dim>> ProtectedBands<dim>::contacts(const Components<dim>& before,
                                                           const Components<dim>& after) const {
  const double reach = 2 * margin * grid_.resolution() + after.samples.spacing()[0];
  const auto at_rim = [&](const Component<dim>& hole) { return hole.innermost[0] - inner_edge_ < reach; };
  const auto at_tread = [&](const Component<dim>& hole) { return outer_edge_ - hole.outermost[0] < reach; };
  const auto were = overlapping_holes(after, before);
  std::vector<ShapeEvent<dim>> events;
  for (std::size_t k = 0; k < after.all.size(); ++k) {
    const Component<dim>& hole = after.all[k];
    if (hole.is_material) continue;
    const auto was = [&](const auto& there) {
      return std::any_of(were[k].begin(), were[k].end(), [&](int old) { return there(before.all[old]); });
    };
    if (at_rim(hole) && !was(at_rim))
      events.push_back({ShapeEventKind::hole_at_rim_band, hole.innermost, hole.measure});
    if (at_tread(hole) && !was(at_tread))
      events.push_back({ShapeEventKind::hole_at_tread_band, hole.outermost, hole.measure});
  }
  return events;
}

template class ProtectedBands<2>;
template class ProtectedBands<3>;

}  // namespace wheelwright
