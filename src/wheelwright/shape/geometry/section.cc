#include "wheelwright/shape/geometry/section.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// The section at a place `xi` from 0 to 1 in a layer of cells.
LevelSet<2> section_in(const LevelSet<3>& psi, int cell, double xi) {
  const int degree = psi.lattice.degree();
  const Lagrange1D basis(degree, xi);
  const Lattice<2> plane = section_lattice(psi.lattice);
  LevelSet<2> section{plane, std::vector<double>(plane.n_nodes(), 0.0)};
  for (int node = 0; node < plane.n_nodes(); ++node) {
    const auto p = plane.node_position(node);
    for (int a = 0; a <= degree; ++a)
      if (basis.value[a] != 0)
        section.values[node] +=
            basis.value[a] * psi.values[psi.lattice.node_index({p[0], p[1], degree * cell + a})];
  }
  return section;
}

}  // namespace

template <>
LevelSet<2> mid_plane_section(const LevelSet<2>& psi) {
  return psi;
}

template <>
LevelSet<2> mid_plane_section(const LevelSet<3>& psi) {
  const int cells = psi.lattice.grid().cells[2];
  return section_in(psi, cells / 2, 0.5 * (cells % 2));
}

LevelSet<2> section_at(const LevelSet<3>& psi, double z) {
  const PolarGrid<3>& grid = psi.lattice.grid();
  const double layer = z / grid.axial_size();
  const int cell = std::clamp(static_cast<int>(std::floor(layer)), 0, grid.cells[2] - 1);
  return section_in(psi, cell, layer - cell);
}

Lattice<2> section_lattice(const Lattice<3>& lattice) {
  const PolarGrid<3>& grid = lattice.grid();
  return {{grid.inner_radius,
           grid.outer_radius,
           grid.width,
           grid.n_sectors,
           {grid.cells[0], grid.cells[1]},
           grid.fixed_lines},
          lattice.degree()};
}

LevelSet<3> extruded(const LevelSet<2>& section, const Lattice<3>& lattice) {
  LevelSet<3> psi{lattice, std::vector<double>(lattice.n_nodes())};
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.node_position(node);
    psi.values[node] = section.values[section.lattice.node_index({p[0], p[1]})];
  }
  return psi;
}

}  // namespace wheelwright
