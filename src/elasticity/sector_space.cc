#include "elasticity/sector_space.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
SectorSpace<dim>::SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows)
    : lattice_(domain.grid, degree), core_rows_(core_rows) {
  const PolarGrid<dim>& grid = domain.grid;
  std::array<int, dim> last{};
  for (int d = 0; d < dim; ++d) last[d] = lattice_.nodes()[d] - 1;
  last[1] = degree * grid.cells[1] + degree;
  numbers_.assign(extended_index(last) + 1, -1);

  constexpr int used = 0;
  const auto mark = [&](int cell, int sectors_ahead) {
    const auto c = grid.cell_position(cell);
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
      auto p = local_node_position<dim>(degree, a);
      for (int d = 0; d < dim; ++d) p[d] += degree * c[d];
      p[1] += sectors_ahead * degree * grid.cells[1];
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
std::vector<int> SectorSpace<dim>::cell_nodes(int cell, int sectors_ahead) const {
  const int degree = lattice_.degree();
  const auto c = grid().cell_position(cell);
  std::vector<int> nodes(nodes_per_cell<dim>(degree));
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a) {
    auto p = local_node_position<dim>(degree, a);
    for (int d = 0; d < dim; ++d) p[d] += degree * c[d];
    p[1] += sectors_ahead * degree * grid().cells[1];
    nodes[a] = number(p);
  }
  return nodes;
}

namespace {

/// Lattice positions first <= p < last along each axis.
template <int dim>
struct Box {
  std::array<int, dim> first, last;
};

template <int dim>
void append_all(const Box<dim>& box, std::vector<std::array<int, dim>>& order) {
  std::array<int, dim> p = box.first;
  for (int d = 0; d < dim; ++d)
    if (box.first[d] >= box.last[d]) return;
  while (true) {
    order.push_back(p);
    int d = 0;
    while (d < dim && ++p[d] == box.last[d]) {
      p[d] = box.first[d];
      ++d;
    }
    if (d == dim) return;
  }
}

template <int dim>
void dissect(const Box<dim>& box, int degree, std::vector<std::array<int, dim>>& order) {
  int axis = 0;
  for (int d = 1; d < dim; ++d)
    if (box.last[d] - box.first[d] > box.last[axis] - box.first[axis]) axis = d;
  const int length = box.last[axis] - box.first[axis];
  if (length <= 3 * degree) return append_all<dim>(box, order);
  // Separators on cell boundaries split the cells' couplings.
  const int middle = (box.first[axis] + length / 2) / degree * degree;
  Box<dim> before = box, separator = box, after = box;
  before.last[axis] = separator.first[axis] = middle;
  separator.last[axis] = after.first[axis] = middle + 1;
  dissect<dim>(before, degree, order);
  dissect<dim>(after, degree, order);
  append_all<dim>(separator, order);
}

}  // namespace

template <int dim>
std::vector<std::array<int, dim>> nested_dissection(const PolarGrid<dim>& grid, int degree, int core_rows) {
  Box<dim> box;
  for (int d = 0; d < dim; ++d) {
    box.first[d] = 0;
    box.last[d] = degree * grid.cells[d] + 1;
  }
  box.first[0] = 1;
  box.last[0] = degree * core_rows + 1;
  box.last[1] = degree * grid.cells[1] + degree + 1;
  std::vector<std::array<int, dim>> order;
  dissect<dim>(box, degree, order);
  return order;
}

template class SectorSpace<2>;
template class SectorSpace<3>;
template std::vector<std::array<int, 2>> nested_dissection<2>(const PolarGrid<2>&, int, int);
template std::vector<std::array<int, 3>> nested_dissection<3>(const PolarGrid<3>&, int, int);

}  // namespace wheelwright
