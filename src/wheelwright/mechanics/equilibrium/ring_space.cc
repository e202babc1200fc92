#include "wheelwright/mechanics/equilibrium/ring_space.h"

#include "wheelwright/base/periodic.h"

namespace wheelwright {

template <int dim>
RingSpace<dim>::RingSpace(const CutDomain<dim>& domain, int degree) : lattice_(domain.grid, degree) {
  const PolarGrid<dim>& grid = domain.grid;
  std::vector<bool> used(lattice_.n_nodes(), false);
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    for (int a = 0; domain.active(cell) && a < nodes_per_cell<dim>(degree); ++a)
      if (const auto p = lattice_.cell_node(grid.cell_position(cell), a); p[0] > 0)
        used[lattice_.node_index(p)] = true;
  numbers_.assign(lattice_.n_nodes(), -1);
  for (int i = 0; i < lattice_.n_nodes(); ++i)
    if (used[i]) {
      numbers_[i] = n_nodes_of_sector();
      positions_.push_back(lattice_.node_position(i));
    }
}

template <int dim>
int RingSpace<dim>::number(std::array<int, dim> position) const {
  const int per_sector = lattice_.nodes()[1];
  position[1] = wrap(position[1], per_sector * grid().n_sectors);
  const int of_sector = numbers_[lattice_.node_index(position)];
  return of_sector < 0 ? -1 : of_sector + n_nodes_of_sector() * (position[1] / per_sector);
}

template <int dim>
std::vector<int> RingSpace<dim>::cell_nodes(int cell, int sector) const {
  std::vector<int> nodes(nodes_per_cell<dim>(degree()));
  auto place = grid().cell_position(cell);
  place[1] += sector * grid().columns();
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a) nodes[a] = number(lattice_.cell_node(place, a));
  return nodes;
}

template <int dim>
void RingSpace<dim>::gather(int cell, int sector, const double* ring, double* of_cell) const {
  const auto nodes = cell_nodes(cell, sector);
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim; ++c) of_cell[dim * a + c] = nodes[a] < 0 ? 0 : ring[dof(nodes[a], c)];
}

template <int dim>
void RingSpace<dim>::scatter(int cell, int sector, const double* of_cell, double* ring) const {
  const auto nodes = cell_nodes(cell, sector);
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; nodes[a] >= 0 && c < dim; ++c) ring[dof(nodes[a], c)] += of_cell[dim * a + c];
}

template class RingSpace<2>;
template class RingSpace<3>;

}  // namespace wheelwright
