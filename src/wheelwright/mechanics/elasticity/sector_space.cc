#include "wheelwright/mechanics/elasticity/sector_space.h"

#include <algorithm>

#include "wheelwright/mechanics/elasticity/element.h"

namespace wheelwright {

template <int dim>
SectorSpace<dim>::SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows, SideFaces sides,
                              const GhostPenalty& ghost)
    : lattice_(domain.grid, degree), core_rows_(core_rows), sides_(sides), ghost_(ghost) {
  const PolarGrid<dim>& grid = domain.grid;
  std::array<int, dim> last{};
  for (int d = 0; d < dim; ++d) last[d] = lattice_.nodes()[d] - 1;
  last[1] = last_line() + most_derivatives;
  numbers_.assign(index(last) + 1, -1);

  constexpr int used = 0;
  const auto mark = [&](const std::array<int, dim>& p) {
    if (p[0] > 0) numbers_[index(p)] = used;
  };
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    if (domain.active(cell) && grid.cell_position(cell)[0] < core_rows)
      for (int a = 0; a < nodes_per_cell<dim>(degree); ++a)
        mark(lattice_.cell_node(grid.cell_position(cell), a));
  for (const GhostFace& face : domain.ghost_faces) {
    if (!wraps(face) || !penalizes(face) || ghost.xi == 0) continue;
    std::ranges::for_each(face_positions(face.minus, Face::last), mark);
    std::ranges::for_each(face_positions(face.plus, Face::first), mark);
  }

  const int line = lattice_.nodes_per_line();
  for (int i = 0; i < static_cast<int>(numbers_.size()); ++i) {
    if (numbers_[i] != used) continue;
    numbers_[i] = n_nodes();
    std::array<int, dim> p{};
    int rest = i % line;
    p[0] = rest % lattice_.nodes()[0];
    if constexpr (dim == 3) p[2] = rest / lattice_.nodes()[0];
    p[1] = i / line - most_derivatives;
    positions_.push_back(p);
  }
}

template <int dim>
int SectorSpace<dim>::index(const std::array<int, dim>& p) const {
  int index = p[1] + most_derivatives;
  if constexpr (dim == 3) index = index * lattice_.nodes()[2] + p[2];
  return index * lattice_.nodes()[0] + p[0];
}

template <int dim>
std::vector<std::array<int, dim>> SectorSpace<dim>::face_positions(int cell, Face face) const {
  std::vector<std::array<int, dim>> positions;
  for (int k = 1; k <= n_compared_derivatives(ghost_, degree()); ++k)
    for (int a = 0; a < nodes_per_cell<dim>(degree()); ++a) {
      if (local_node_position<dim>(degree(), a)[1] != 0) continue;
      auto p = lattice_.cell_node(grid().cell_position(cell), a);
      p[1] = face == Face::first ? -k : last_line() + k;
      positions.push_back(p);
    }
  return positions;
}

template <int dim>
std::vector<int> SectorSpace<dim>::cell_nodes(int cell) const {
  std::vector<int> nodes(nodes_per_cell<dim>(degree()));
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a)
    nodes[a] = number(lattice_.cell_node(grid().cell_position(cell), a));
  return nodes;
}

template <int dim>
std::vector<int> SectorSpace<dim>::cell_and_face_nodes(int cell, Face face) const {
  auto nodes = cell_nodes(cell);
  for (const auto& p : face_positions(cell, face)) nodes.push_back(number(p));
  return nodes;
}

template class SectorSpace<2>;
template class SectorSpace<3>;

}  // namespace wheelwright
