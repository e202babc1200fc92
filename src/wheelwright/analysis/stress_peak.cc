#include "wheelwright/analysis/stress_peak.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// e:e - (tr e)^2 / 3, the square of the strain's deviator: the von Mises stress is mu sqrt(6) times its
/// root. When dim = 2, e_33 is `axial_strain_ratio` times the trace in the plane.
template <int dim>
double squared_deviator(const double* strain, double axial_strain_ratio) {
  double trace = 0, square = 0;
  for (int k = 0; k < dim; ++k) {
    trace += strain[k];
    square += strain[k] * strain[k];
  }
  if constexpr (dim == 2) {
    const double axial = axial_strain_ratio * trace;
    trace += axial;
    square += axial * axial;
  }
  for (int k = dim; k < n_strains<dim>; ++k) square += 0.5 * strain[k] * strain[k];
  return square - trace * trace / 3;
}

}  // namespace

template <int dim>
std::vector<double> peak_von_mises(const StateSolver<dim>& solver, const State<dim>& state) {
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto displacement = state.displacement();
  std::vector<double> peaks(state.positions().size(), 0.0);
  const auto full = unit_cell_rule<dim>(solver.model().degree + 1);
  auto cut = state.domain().cut.begin();
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const bool is_cut = cut != state.domain().cut.end() && cut->cell == cell;
    const std::span<const ReferencePoint<dim>> points = is_cut ? (cut++)->material : full;
    if (!state.domain().active(cell) || points.empty()) continue;
    std::vector<Vec<dim>> xi;
    for (const auto& point : points) xi.push_back(point.xi);
    const Material& material = solver.model().materials.in_row(grid.cell_position(cell)[0]);
    const double mu = material.mu(), axial = material.axial_strain_ratio();
    const Matrix strains = displacement->strains(cell, xi);
    for (int j = 0; j < strains.columns(); ++j) {
      double& peak = peaks[j / grid.n_sectors];
      for (int row = 0; row < strains.rows(); row += n_strains<dim>)
        peak = std::max(peak, mu * mu * squared_deviator<dim>(strains.column(j) + row, axial));
    }
  }
  for (double& peak : peaks) peak = std::sqrt(6 * peak);
  return peaks;
}

template std::vector<double> peak_von_mises(const StateSolver<2>&, const State<2>&);
template std::vector<double> peak_von_mises(const StateSolver<3>&, const State<3>&);

}  // namespace wheelwright
