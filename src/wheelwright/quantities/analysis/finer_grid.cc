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

}  // namespace

template <int dim>
RollingModel<dim> on_finer_grid(RollingModel<dim> model) {
  model.design_lines.clear();
  const std::array<int, dim> before = model.grid.cells;
  const auto equal_rows = model.grid.all_equal_rows();
  auto& cells = model.grid.cells;
  int line = 0;  // the last fixed one
  for (std::size_t k = 0; k + 1 < equal_rows.size(); ++k)
    model.grid.fixed_lines[k].line = line += more_cells<dim>(equal_rows[k].count());
  const int rows_before = equal_rows.back().count();
  int rows = more_cells<dim>(rows_before);
  // Whether the condensed rows, where tractions are observed in them, stay as thick as they are, and layers
  // of materials end on lines of the grid.
  const auto keeps_lines = [&] {
    cells[0] = line + rows;
    return (model.tread.annulus_points == 0 || model.tread.rows * rows % rows_before == 0) &&
           model.materials.fit(model.grid);
  };
  while (!keeps_lines()) ++rows;
  for (int d = 1; d < dim; ++d) cells[d] = more_cells<dim>(before[d]);
  if constexpr (dim == 3)
    if (before[2] % 2 == 0) cells[2] += cells[2] % 2;
  model.tread.rows = std::max(1, model.tread.rows * rows / rows_before);
  return model;
}

template <int dim>
double refinement(const PolarGrid<dim>& grid, const PolarGrid<dim>& finer) {
  const auto coarse_rows = grid.all_equal_rows(), fine_rows = finer.all_equal_rows();
  double minimum = finer.cells[0] / static_cast<double>(grid.cells[0]);
  for (std::size_t k = 0; k < coarse_rows.size(); ++k)
    minimum = std::min(minimum, fine_rows[k].count() / static_cast<double>(coarse_rows[k].count()));
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
