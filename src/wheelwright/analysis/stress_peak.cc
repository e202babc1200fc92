#include "wheelwright/analysis/stress_peak.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// e:e - (tr e)^2 / 3, the square of the strain's deviator: von Mises' stress is mu sqrt(6) times its root.
/// With e_33 = 0 when dim = 2.
template <int dim>
double squared_deviator(const double* strain) {
  double trace = 0, square = 0;
  for (int k = 0; k < dim; ++k) {
    trace += strain[k];
    square += strain[k] * strain[k];
  }
  for (int k = dim; k < n_strains<dim>; ++k) square += 0.5 * strain[k] * strain[k];
  return square - trace * trace / 3;
}

/// Raises every position's largest squared deviator by the points of cells that share an element. `dofs`: one
/// column for every (position, cell).
template <int dim>
void raise_peaks(const ElasticElement<dim>& element, std::span<const ReferencePoint<dim>> points,
                 const Matrix& dofs, std::vector<double>& peaks) {
  const int n_strain = n_strains<dim>, per_position = dofs.columns() / static_cast<int>(peaks.size());
  Matrix strain(n_strain * static_cast<int>(points.size()), element.n_dofs());
  for (size_t q = 0; q < points.size(); ++q) {
    const auto at = element.at(points[q].xi);
    for (int j = 0; j < element.n_dofs(); ++j)
      for (int k = 0; k < n_strain; ++k) strain(n_strain * static_cast<int>(q) + k, j) = at.strain[k][j];
  }
  const Matrix strains = product(strain, Op::none, dofs, Op::none);
  for (int j = 0; j < strains.columns(); ++j) {
    double& peak = peaks[j / per_position];
    for (int row = 0; row < strains.rows(); row += n_strain)
      peak = std::max(peak, squared_deviator<dim>(strains.column(j) + row));
  }
}

template <int dim>
void raise_peaks_in_core(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                         std::vector<double>& peaks) {
  const auto full = unit_cell_rule<dim>(problem.model().degree + 1);
  const SectorFields v = complete_displacement(s);
  auto cut = s.domain.cut.begin();
  for (int cell = 0; cell < s.domain.grid.n_cells(); ++cell) {
    const bool is_cut = cut != s.domain.cut.end() && cut->cell == cell;
    const std::span<const ReferencePoint<dim>> points = is_cut ? (cut++)->material : full;
    const int radial = s.domain.grid.cell_position(cell)[0];
    if (!s.domain.active(cell) || radial >= problem.core_rows() || points.empty()) continue;
    const auto& element = problem.elements().element(radial);
    Matrix modes(v.modes.rows(), element.n_dofs());
    gather(s.ring, s.ring.sector().space.cell_nodes(cell), v.modes, modes);
    raise_peaks<dim>(element, points, product(modes, Op::transpose, v.weights, Op::transpose), peaks);
  }
}

/// The tread's displacements at the grid's nodes, by cells.
template <int dim>
class TreadCells {
 public:
  TreadCells(const RollingProblem<dim>& problem, const RollingSolution<dim>& s)
      : problem_(problem),
        loads_(tread_loads(problem.tread(), s.tread_loads)),
        field_(tread_field(problem.tread(), s.outer_line, loads_)),
        nodal_(nodal_displacements(problem.tread(), field_, loads_)) {}

  /// One column for every (position, ring column). `row` and `axial` are the cell's, the first row lowest.
  Matrix dofs(int row, int axial) const {
    const int degree = problem_.model().degree, n_columns = problem_.tread().n_columns();
    const int height = degree * problem_.tread().rows();
    int axial_nodes = 1;
    if constexpr (dim == 3) axial_nodes = degree * problem_.model().grid.cells[2] + 1;
    Matrix result(dim * nodes_per_cell<dim>(degree), nodal_.columns());
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
      const auto p = local_node_position<dim>(degree, a);
      const int line = degree * row + p[0];
      int axial_node = degree * axial;
      if constexpr (dim == 3) axial_node += p[2];
      for (int j = 0; j < result.columns(); ++j) {
        const int c = j % n_columns, source = p[1] < degree ? j : j - c + (c + 1) % n_columns;
        const double* u = line == 0
                              ? field_.base.column(j) + dim * (p[1] * axial_nodes + axial_node)
                              : nodal_.column(source) +
                                    dim * ((p[1] % degree * axial_nodes + axial_node) * height + line - 1);
        std::copy_n(u, dim, result.column(j) + dim * a);
      }
    }
    return result;
  }

 private:
  const RollingProblem<dim>& problem_;
  TreadLoads loads_;
  TreadField field_;
  Matrix nodal_;
};

template <int dim>
void raise_peaks_in_tread(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                          std::vector<double>& peaks) {
  const TreadCells<dim> cells(problem, s);
  const auto points = unit_cell_rule<dim>(problem.model().degree + 1);
  int axial_cells = 1;
  if constexpr (dim == 3) axial_cells = problem.model().grid.cells[2];
  for (int row = 0; row < problem.tread().rows(); ++row)
    for (int axial = 0; axial < axial_cells; ++axial)
      raise_peaks<dim>(problem.elements().element(problem.core_rows() + row), points, cells.dofs(row, axial),
                       peaks);
}

}  // namespace

template <int dim>
std::vector<double> peak_von_mises(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution) {
  std::vector<double> peaks(solution.positions.grounds.size(), 0.0);
  raise_peaks_in_core(problem, solution, peaks);
  raise_peaks_in_tread(problem, solution, peaks);
  for (double& peak : peaks) peak = problem.model().material.mu() * std::sqrt(6 * peak);
  return peaks;
}

template std::vector<double> peak_von_mises(const RollingProblem<2>&, const RollingSolution<2>&);
template std::vector<double> peak_von_mises(const RollingProblem<3>&, const RollingSolution<3>&);

}  // namespace wheelwright
