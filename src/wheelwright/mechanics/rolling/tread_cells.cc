#include "wheelwright/mechanics/rolling/tread_cells.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
TreadCells<dim>::TreadCells(const Tread<dim>& tread, const PolarGrid<dim>& grid, int degree)
    : tread_(tread),
      degree_(degree),
      core_rows_(grid.cells[0] - tread.rows()),
      height_(degree * tread.rows()),
      axial_nodes_(1) {
  if constexpr (dim == 3) axial_nodes_ = degree * grid.cells[2] + 1;
}

template <int dim>
typename TreadCells<dim>::Place TreadCells<dim>::place(int radial, int axial, int local_node) const {
  const auto p = local_node_position<dim>(degree_, local_node);
  const int line = degree_ * (radial - core_rows_) + p[0];
  int axial_node = degree_ * axial;
  if constexpr (dim == 3) axial_node += p[2];
  // The base knows all of the column's azimuth lines, the nodes above it only those up to the next column's.
  if (line == 0) return {true, dim * (p[1] * axial_nodes_ + axial_node), false};
  std::array<int, dim> node{degree_ * core_rows_ + line, p[1]};
  if constexpr (dim == 3) node[2] = axial_node;
  return {false, row_of_node(node), p[1] == degree_};
}

template <int dim>
int TreadCells<dim>::row_of_node(const std::array<int, dim>& node) const {
  int axial_node = 0;
  if constexpr (dim == 3) axial_node = node[2];
  const int line = node[0] - degree_ * core_rows_;
  return dim * ((node[1] % degree_ * axial_nodes_ + axial_node) * height_ + line - 1);
}

template <int dim>
int TreadCells<dim>::field(const Place& place, int column) const {
  if (!place.in_next_column) return column;
  return (column + 1) % tread_.n_columns() == 0 ? column + 1 - tread_.n_columns() : column + 1;
}

template <int dim>
Matrix TreadCells<dim>::displacements(int radial, int axial, const TreadField& tread_field,
                                      const Matrix& nodal) const {
  Matrix result(dim * nodes_per_cell<dim>(degree_), nodal.columns());
  for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a) {
    const Place from = place(radial, axial, a);
    const Matrix& values = from.on_base ? tread_field.base : nodal;
    for (int j = 0; j < result.columns(); ++j)
      std::copy_n(values.column(field(from, j)) + from.row, dim, result.column(j) + dim * a);
  }
  return result;
}

template <int dim>
void TreadCells<dim>::add_loads(int radial, int axial, const Matrix& loads, TreadForces& forces) const {
  for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a) {
    const Place to = place(radial, axial, a);
    Matrix& values = to.on_base ? forces.on_base : forces.on_nodes;
    for (int j = 0; j < loads.columns(); ++j)
      for (int c = 0; c < dim; ++c) values(to.row + c, field(to, j)) += loads(dim * a + c, j);
  }
}

template <int dim>
TreadForces TreadCells<dim>::no_forces(int n_fields) const {
  const TreadColumn<dim>& column = tread_.column();
  return {Matrix(column.observation.rows(), n_fields), Matrix(column.n_base, n_fields),
          Matrix(column.nodal.rows(), n_fields)};
}

template class TreadCells<2>;
template class TreadCells<3>;

}  // namespace wheelwright
