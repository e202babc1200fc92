#include "wheelwright/shape/cut/measure.h"

#include <algorithm>
#include <limits>

#include "wheelwright/shape/cut/cell_quadrature.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

constexpr int gauss_points = 4;

template <int degree, int dim>
double cell_measure(const CellMap<dim>& map, const std::vector<ReferencePoint<dim>>& points) {
  double sum = 0;
  for (const auto& point : points)
    sum += point.weight * determinant<dim>(map.jacobian(ShapeFunctions<dim>(degree, point.xi)));
  return sum;
}

template <int dim>
double cell_measure(const CellMap<dim>& map, int degree, const std::vector<ReferencePoint<dim>>& points) {
  return degree == 1 ? cell_measure<1>(map, points) : cell_measure<2>(map, points);
}

}  // namespace

template <int dim>
double material_measure(const LevelSet<dim>& psi) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto domain = cut_domain(psi, gauss_points);
  return domain ? material_measure(*domain, psi.lattice.degree()) : unknown;
}

template <int dim>
double material_measure(const CutDomain<dim>& domain, int map_degree) {
  return measures_by_annulus<dim>(domain, map_degree, std::vector<int>(domain.grid.cells[0], 0)).front();
}

template <int dim>
std::vector<double> measures_by_annulus(const CutDomain<dim>& domain, int map_degree,
                                        std::span<const int> annulus_of_row) {
  const PolarGrid<dim>& grid = domain.grid;
  const auto whole_cell = unit_cell_rule<dim>(gauss_points);
  std::vector<double> full_cell(grid.cells[0]);
  for (int radial = 0; radial < grid.cells[0]; ++radial)
    full_cell[radial] = cell_measure<dim>(CellMap<dim>(grid, map_degree, {radial}), map_degree, whole_cell);
  std::vector<double> sums(1 + std::ranges::max(annulus_of_row), 0.0);
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const int row = grid.cell_position(cell)[0];
    if (domain.kinds[cell] == CellKind::inside) sums[annulus_of_row[row]] += full_cell[row];
  }
  for (const CutCell<dim>& cut : domain.cut) {
    const auto place = grid.cell_position(cut.cell);
    sums[annulus_of_row[place[0]]] +=
        cell_measure<dim>(CellMap<dim>(grid, map_degree, place), map_degree, cut.material);
  }
  return sums;
}

template <int dim>
std::vector<SurfaceSample<dim>> boundary_samples(const LevelSet<dim>& psi) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const int degree = psi.lattice.degree();
  std::vector<SurfaceSample<dim>> samples;
  CellQuadrature<dim> quadrature(degree, gauss_points);
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const auto values = psi.cell_values(cell);
    if (quadrature.classify(values) != CellKind::cut) continue;
    const auto split = quadrature.split(cell, values);
    if (!split) continue;
    const auto position = grid.cell_position(cell);
    const CellMap<dim> map(grid, degree, position);
    for (const auto& point : split->boundary) {
      const auto surface =
          map_surface<dim>(map.jacobian(ShapeFunctions<dim>(degree, point.xi)), point.normal);
      samples.push_back({{cell, point.xi, rotated<dim>(surface.normal, position[1] * grid.column_angle()),
                          point.weight * surface.scale},
                         1});
    }
  }
  return samples;
}

template double material_measure(const LevelSet<2>&);
template double material_measure(const LevelSet<3>&);
template double material_measure(const CutDomain<2>&, int);
template double material_measure(const CutDomain<3>&, int);
template decltype(measures_by_annulus<2>) measures_by_annulus<2>;
template decltype(measures_by_annulus<3>) measures_by_annulus<3>;
template decltype(boundary_samples<2>) boundary_samples<2>;
template decltype(boundary_samples<3>) boundary_samples<3>;

}  // namespace wheelwright
