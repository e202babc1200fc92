#include "wheelwright/quantities/analysis/finer_grid.h"

#include <algorithm>

#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {
namespace {

/// The number of cells along an axis of the finer grid.
template <int dim>
int more_cells(int cells) {
  return dim == 2 ? 2 * cells : (4 * cells + 2) / 3;
}

/// The fewest radial cells, at least so many, with which the condensed rows stay as thick as they are.
int radial_cells_with_rows(int cells, int finer, int rows) {
  while (rows * finer % cells != 0) ++finer;
  return finer;
}

}  // namespace

template <int dim>
RollingModel<dim> on_finer_grid(RollingModel<dim> model) {
  const std::array<int, dim> before = model.grid.cells;
  auto& cells = model.grid.cells;
  for (int d = 0; d < dim; ++d) cells[d] = more_cells<dim>(before[d]);
  if constexpr (dim == 3)
    if (before[2] % 2 == 0) cells[2] += cells[2] % 2;
  if (model.tread.annulus_points > 0)
    cells[0] = radial_cells_with_rows(before[0], cells[0], model.tread.rows);
  model.tread.rows = std::max(1, model.tread.rows * cells[0] / before[0]);
  return model;
}

template <int dim>
double refinement(const PolarGrid<dim>& grid, const PolarGrid<dim>& finer) {
  double minimum = finer.cells[0] / static_cast<double>(grid.cells[0]);
  for (int d = 1; d < dim; ++d)
    minimum = std::min(minimum, finer.cells[d] / static_cast<double>(grid.cells[d]));
  return minimum;
}

template <int dim>
LevelSet<dim> on_grid(const LevelSet<dim>& psi, const PolarGrid<dim>& grid) {
  return values_on(psi, Lattice<dim>(grid, psi.lattice.degree()));
}

template <int dim>
double dof_bound(const RollingModel<dim>& model) {
  double nodes = static_cast<double>(model.degree) * model.grid.ring_columns();
  for (int d = 0; d < dim; ++d)
    if (d != 1) nodes *= model.degree * model.grid.cells[d] + 1;
  return dim * nodes;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                        \
  template decltype(on_finer_grid<dim>) on_finer_grid<dim>; \
  template decltype(refinement<dim>) refinement<dim>;       \
  template decltype(on_grid<dim>) on_grid<dim>;             \
  template decltype(dof_bound<dim>) dof_bound<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
