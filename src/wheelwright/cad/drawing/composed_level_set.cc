#include "wheelwright/cad/drawing/composed_level_set.h"

#include "wheelwright/base/parallel.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, const Composition& composition) {
  const PolarGrid<dim>& grid = lattice.grid();
  LevelSet<dim> psi{lattice, std::vector<double>(lattice.n_nodes(), grid.inner_radius - grid.outer_radius)};
  if (composition.boundary().empty()) return psi;
  const auto nodes = lattice.nodes();
  parallel_for(nodes[1], [&](int line) {
    // The distance changes at most as much as the place does, which bounds the search.
    double bound = 4 * grid.outer_radius;
    Point last{};
    for (int i = 0; i < nodes[0]; ++i) {
      std::array<int, dim> position{};
      position[0] = i;
      position[1] = line;
      const Vec<dim> x = cartesian<dim>(lattice.polar_point(position));
      const Point at{x[0], x[1]};
      constexpr double rounding = 1 + 1e-12;
      if (i > 0) bound = rounding * (bound + distance(at, last));
      bound = composition.distance(at, bound);
      last = at;
      const double value = composition.is_hole(at) ? bound : -bound;
      for (int layer = 0; layer < lattice.nodes_per_line() / nodes[0]; ++layer) {
        if constexpr (dim == 3) position[2] = layer;
        psi.values[lattice.node_index(position)] = value;
      }
    }
  });
  return psi;
}

template LevelSet<2> make_level_set<2>(const Lattice<2>&, const Composition&);
template LevelSet<3> make_level_set<3>(const Lattice<3>&, const Composition&);

}  // namespace wheelwright
