#include "wheelwright/shape/geometry/values_on.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// Allowed difference between lengths of equal rings, relative to the outer radius.
constexpr double rounding = 1e-9;

template <int dim>
LevelSet<dim> values_of_nodes(const LevelSet<dim>& psi, const Lattice<dim>& lattice) {
  LevelSet<dim> result{lattice, std::vector<double>(lattice.n_nodes())};
  for (int node = 0; node < lattice.n_nodes(); ++node)
    result.values[node] = psi.values[psi.lattice.node_index(lattice.node_position(node))];
  return result;
}

}  // namespace

template <int dim>
std::string misfit(const PolarGrid<dim>& of_shape, const PolarGrid<dim>& grid) {
  const double most = rounding * grid.outer_radius;
  const auto differ = [&](double a, double b) { return std::abs(a - b) > most; };
  if (differ(of_shape.inner_radius, grid.inner_radius) || differ(of_shape.outer_radius, grid.outer_radius))
    return fmt::format("its ring reaches from {:.9g} m to {:.9g} m, not from {:.9g} m to {:.9g} m",
                       of_shape.inner_radius, of_shape.outer_radius, grid.inner_radius, grid.outer_radius);
  if (dim == 3 && differ(of_shape.width, grid.width))
    return fmt::format("its width is {:.9g} m, not {:.9g} m", of_shape.width, grid.width);
  if (of_shape.n_sectors % grid.n_sectors != 0)
    return fmt::format("it has {} sectors, of which {} equal ones cannot be made", of_shape.n_sectors,
                       grid.n_sectors);
  return {};
}

template <int dim>
bool have_same_nodes(const Lattice<dim>& a, const Lattice<dim>& b) {
  const PolarGrid<dim>&first = a.grid(), &second = b.grid();
  bool is_same = a.degree() == b.degree() && first.ring_columns() == second.ring_columns();
  for (int d = 0; d < dim; ++d) is_same = is_same && (d == 1 || first.cells[d] == second.cells[d]);
  const double most = rounding * first.outer_radius;
  for (int row = 0; row < first.cells[0] && is_same; ++row)
    is_same = std::abs(first.row_height(row) - second.row_height(row)) <= most;
  return is_same;
}

template <int dim>
double value_at(const LevelSet<dim>& psi, const Vec<dim>& polar) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  std::array<int, dim> cell;
  Vec<dim> xi;
  for (int d = 0; d < dim; ++d) {
    double cells = polar[d];  // from the start of the axis
    if (d == 0)
      cells = grid.line_at(polar[0]);
    else if (d == 1)
      cells =
          (polar[1] - std::floor(polar[1] / grid.sector_angle()) * grid.sector_angle()) / grid.column_angle();
    else if constexpr (dim == 3)
      cells /= grid.axial_size();
    cell[d] = std::clamp(static_cast<int>(std::floor(cells)), 0, grid.cells[d] - 1);
    xi[d] = cells - cell[d];
  }
  const ShapeFunctions<dim> shape(psi.lattice.degree(), xi);
  double value = 0;
  for (int a = 0; a < nodes_per_cell<dim>(psi.lattice.degree()); ++a)
    value += shape.value[a] * psi.values[psi.lattice.node_index(psi.lattice.cell_node(cell, a))];
  return value;
}

template <int dim>
LevelSet<dim> values_on(const LevelSet<dim>& psi, const Lattice<dim>& lattice) {
  if (have_same_nodes(psi.lattice, lattice)) return values_of_nodes(psi, lattice);
  LevelSet<dim> result{lattice, std::vector<double>(lattice.n_nodes())};
  for (int node = 0; node < lattice.n_nodes(); ++node)
    result.values[node] = value_at<dim>(psi, lattice.polar_point(node));
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                         \
  template std::string misfit(const PolarGrid<dim>&, const PolarGrid<dim>&); \
  template bool have_same_nodes(const Lattice<dim>&, const Lattice<dim>&);   \
  template double value_at<dim>(const LevelSet<dim>&, const Vec<dim>&);      \
  template LevelSet<dim> values_on(const LevelSet<dim>&, const Lattice<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
