#include "wheelwright/elasticity/sector_space.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
SectorSpace<dim>::SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows, SideFaces sides)
    : lattice_(domain.grid, degree), core_rows_(core_rows), sides_(sides) {
  const PolarGrid<dim>& grid = domain.grid;
  std::array<int, dim> last{};
  for (int d = 0; d < dim; ++d) last[d] = lattice_.nodes()[d] - 1;
  last[1] = degree * grid.cells[1] + degree;
  numbers_.assign(extended_index(last) + 1, -1);

  constexpr int used = 0;
  const auto mark = [&](int cell, int sectors_ahead) {
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
      const auto p = cell_node(cell, a, sectors_ahead);
      if (p[0] > 0) numbers_[extended_index(p)] = used;
    }
  };
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    if (domain.active(cell) && grid.cell_position(cell)[0] < core_rows) mark(cell, 0);
  for (const GhostFace& face : domain.ghost_faces)
    if (wraps(face) && holds(face)) mark(face.plus, 1);

  const int line = lattice_.nodes_per_line();
  for (int i = 0; i < static_cast<int>(numbers_.size()); ++i) {
    if (numbers_[i] != used) continue;
    numbers_[i] = n_nodes();
    std::array<int, dim> p{};
    int rest = i % line;
    p[0] = rest % lattice_.nodes()[0];
    if constexpr (dim == 3) p[2] = rest / lattice_.nodes()[0];
    p[1] = i / line;
    positions_.push_back(p);
  }
}

template <int dim>
int SectorSpace<dim>::extended_index(const std::array<int, dim>& p) const {
  int index = p[1];
  if constexpr (dim == 3) index = index * lattice_.nodes()[2] + p[2];
  return index * lattice_.nodes()[0] + p[0];
}

template <int dim>
std::array<int, dim> SectorSpace<dim>::cell_node(int cell, int local_node, int sectors_ahead) const {
  auto position = lattice_.cell_node(grid().cell_position(cell), local_node);
  position[1] += sectors_ahead * lattice_.nodes()[1];
  return position;
}

template <int dim>
std::vector<int> SectorSpace<dim>::cell_nodes(int cell, int sectors_ahead) const {
  std::vector<int> nodes(nodes_per_cell<dim>(degree()));
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a)
    nodes[a] = number(cell_node(cell, a, sectors_ahead));
  return nodes;
}

template class SectorSpace<2>;
template class SectorSpace<3>;

}  // namespace wheelwright
