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

/// Whether the condensed rows, where tractions are observed in them, stay as thick as they are with this many
/// radial cells, and layers of materials end on lines of the grid.
template <int dim>
bool keeps_lines(const RollingModel<dim>& model, int radial_cells) {
  PolarGrid<dim> finer = model.grid;
  finer.cells[0] = radial_cells;
  return (model.tread.annulus_points == 0 || model.tread.rows * radial_cells % model.grid.cells[0] == 0) &&
         model.materials.fit(finer);
}

}  // namespace

template <int dim>
RollingModel<dim> on_finer_grid(RollingModel<dim> model) {
  const std::array<int, dim> before = model.grid.cells;
  int radial_cells = more_cells<dim>(before[0]);
  while (!keeps_lines(model, radial_cells)) ++radial_cells;
  auto& cells = model.grid.cells;
  cells[0] = radial_cells;
  for (int d = 1; d < dim; ++d) cells[d] = more_cells<dim>(before[d]);
  if constexpr (dim == 3)
    if (before[2] % 2 == 0) cells[2] += cells[2] % 2;
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
