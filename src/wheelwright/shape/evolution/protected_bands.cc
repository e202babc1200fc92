#include "wheelwright/shape/evolution/protected_bands.h"

#include "wheelwright/shape/evolution/moulded_shapes.h"
#include "wheelwright/shape/evolution/printed_shapes.h"
#include "wheelwright/shape/evolution/spline_level_set.h"

namespace wheelwright {

namespace {

/// How close to the edge of the range a boundary counts as lying on it, in units of the resolution.
constexpr double near_edge = 0.1;

/// How much farther the edges of bands extend at a place than at the side face at which they are thinnest.
template <int dim>
double draft_of_bands(const std::optional<Mould>& mould, const PolarGrid<dim>& grid, const Vec<dim>& polar) {
  if constexpr (dim == 3)
    if (mould) {
      const double start = parting_plane_of(*mould, grid) * grid.axial_size();
      return mould->slope * (std::max(start, grid.width - start) - std::abs(polar[2] - start));
    }
  return 0;
}

/// The largest coefficients below a bound whose spline is below it too, at all nodes. They are below the
/// bound inside an annulus, where that has a kink from which it rises.
template <int dim>
std::vector<double> bound_of_coefficients(const Lattice<dim>& lattice, const std::vector<double>& bound) {
  constexpr int max_corrections = 60;
  constexpr double factor = 1.5;  // a coefficient has two thirds of the weight at its vertex
  const double rounding = 1e-10 * lattice.grid().resolution();
  LevelSet<dim> coefficients{lattice, bound};
  for (int k = 0; k < max_corrections; ++k) {
    const LevelSet<dim> spline = spline_level_set(coefficients);
    std::vector<double> excess(bound.size(), 0);  // the largest of the nodes beside a vertex
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const double at_node = spline.values[node] - bound[node];
      if (at_node <= rounding) continue;
      auto inside = lattice.node_position(node), outside = inside;
      inside[0] -= inside[0] % lattice.degree();
      outside[0] += outside[0] % lattice.degree();
      for (const auto& vertex : {inside, outside}) {
        double& largest = excess[lattice.node_index(vertex)];
        largest = std::max(largest, at_node);
      }
    }
    for (std::size_t node = 0; node < bound.size(); ++node)
      coefficients.values[node] -= factor * excess[node];
    if (std::ranges::max(excess) == 0) break;
  }
  return coefficients.values;
}

/// The minimum of the values at the nodes and the bound.
template <int dim>
LevelSet<dim> clipped(LevelSet<dim> psi, const std::vector<double>& bound) {
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    psi.values[node] = std::min(psi.values[node], bound[node]);
  return psi;
}

}  // namespace

template <int dim>
ProtectedBands<dim>::ProtectedBands(const Lattice<dim>& lattice, const Bands& bands)
    : grid_(lattice.grid()),
      range_(hole_range(grid_, bands)),
      between_(bands.between),
      nodes_(lattice.n_nodes()),
      mould_(bands.mould),
      upper_bound_(lattice.n_nodes()) {
  const double rounding = 1e-9 * grid_.resolution();
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<dim> place = lattice.polar_point(node);
    const double radius = place[0];
    nodes_[node] = radius < grid_.inner_radius + bands.rim.thickness - rounding ||
                   radius > grid_.outer_radius - bands.tread.thickness + rounding ||
                   std::ranges::any_of(between_, [&](const SolidAnnulus& solid) {
                     return radius > solid.inner - rounding && radius < solid.outer + rounding;
                   });
    upper_bound_[node] = distance(place);
  }
  bound_of_coefficients_ = mould_ ? upper_bound_ : bound_of_coefficients(lattice, upper_bound_);
  if (mould_) made_ = std::make_shared<const MouldedShapes<dim>>(lattice, *mould_, upper_bound_);
  if constexpr (dim == 3)
    if (bands.print)
      made_ = std::make_shared<const PrintedShapes>(
          lattice, *bands.print, PrintedShapes::Ceiling{upper_bound_, bound_of_coefficients_});
}

/// Radial distance to the nearest edge of where holes may lie; negative outside of it.
template <int dim>
double ProtectedBands<dim>::distance(const Vec<dim>& polar) const {
  const double radius = polar[0];
  double result = std::min(radius - range_.inner, range_.outer - radius);
  // As at the edges of the range: rounding would decide on which side of a grid line a boundary lies.
  const double apart = 0.001 * grid_.resolution();
  for (const SolidAnnulus& solid : between_)
    result = std::min(result, std::max(solid.inner - apart - radius, radius - solid.outer - apart));
  return result - draft_of_bands<dim>(mould_, grid_, polar);
}

template <int dim>
bool ProtectedBands<dim>::touches(const SurfacePoint<dim>& point) const {
  return distance(grid_.polar_point(grid_.cell_position(point.cell), point.xi)) <
         near_edge * grid_.resolution();
}

template <int dim>
LevelSet<dim> ProtectedBands<dim>::keep(LevelSet<dim> psi) const {
  return made_ ? made_->keep(std::move(psi)) : clip(std::move(psi));
}

template <int dim>
LevelSet<dim> ProtectedBands<dim>::keep_design(LevelSet<dim> coefficients) const {
  return made_ ? made_->keep_coefficients(std::move(coefficients)) : clip_design(std::move(coefficients));
}

template <int dim>
LevelSet<dim> ProtectedBands<dim>::clip_design(LevelSet<dim> coefficients) const {
  return clipped(std::move(coefficients), bound_of_coefficients_);
}

template <int dim>
LevelSet<dim> ProtectedBands<dim>::clip(LevelSet<dim> psi) const {
  return clipped(std::move(psi), upper_bound_);
}

template <int dim>
std::vector<ShapeEvent<dim>> ProtectedBands<dim>::contacts(const Components<dim>& before,
                                                           const Components<dim>& after) const {
  const auto reach = [&](double edge) {
    return near_edge * grid_.resolution() + after.samples.spacing(grid_.row_at(edge))[0];
  };
  const auto at_rim = [&](const Component<dim>& hole) {
    return hole.innermost[0] - range_.inner < reach(range_.inner);
  };
  const auto at_tread = [&](const Component<dim>& hole) {
    return range_.outer - hole.outermost[0] < reach(range_.outer);
  };
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
