#include "wheelwright/geometry/shapes.h"

namespace wheelwright {

template <int dim>
double signed_distance(const PolarGrid<dim>& grid, std::span<const Circle> holes, const Vec<dim>& polar) {
  double result = grid.inner_radius - grid.outer_radius;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const Circle& hole = holes[k];
    // The nearest image of the hole is the one whose azimuth differs by at most half a sector.
    const double offset = std::remainder(polar[1] - hole.centre_azimuth, grid.sector_angle());
    const double chord = 2 * std::sqrt(polar[0] * hole.centre_radius) * std::sin(offset / 2);
    const double depth = hole.hole_radius - std::hypot(polar[0] - hole.centre_radius, chord);
    result = k == 0 ? depth : std::max(result, depth);
  }
  return result;
}

template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, std::span<const Circle> holes) {
  LevelSet<dim> psi{lattice, std::vector<double>(lattice.n_nodes())};
  for (int node = 0; node < lattice.n_nodes(); ++node)
    psi.values[node] = signed_distance<dim>(lattice.grid(), holes, lattice.polar_point(node));
  return psi;
}

template double signed_distance<2>(const PolarGrid<2>&, std::span<const Circle>, const Vec<2>&);
template double signed_distance<3>(const PolarGrid<3>&, std::span<const Circle>, const Vec<3>&);
template LevelSet<2> make_level_set<2>(const Lattice<2>&, std::span<const Circle>);
template LevelSet<3> make_level_set<3>(const Lattice<3>&, std::span<const Circle>);

}  // namespace wheelwright
