#include "wheelwright/shape/geometry/annulus.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> in_rows(const LevelSet<dim>& psi, int first, int end) {
  const int degree = psi.lattice.degree();
  PolarGrid<dim> grid = psi.lattice.grid();
  const PolarGrid<dim>& whole = psi.lattice.grid();
  if (end < grid.cells[0]) grid.outer_radius = whole.radius(end);
  if (first > 0) grid.inner_radius = whole.radius(first);
  grid.cells[0] = end - first;
  std::erase_if(grid.fixed_lines,
                [&](const FixedLine& fixed) { return fixed.line <= first || fixed.line >= end; });
  for (FixedLine& fixed : grid.fixed_lines) fixed.line -= first;
  LevelSet<dim> part{Lattice<dim>(grid, degree), {}};
  for (int node = 0; node < part.lattice.n_nodes(); ++node) {
    auto position = part.lattice.node_position(node);
    position[0] += degree * first;
    part.values.push_back(psi.values[psi.lattice.node_index(position)]);
  }
  return part;
}

template decltype(in_rows<2>) in_rows<2>;
template decltype(in_rows<3>) in_rows<3>;

}  // namespace wheelwright
