#include "wheelwright/mechanics/state/strain_peaks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/elasticity/symmetric_tensor.h"
#include "wheelwright/mechanics/state/material_rule.h"
#include "wheelwright/mechanics/state/place_in_body.h"

namespace wheelwright {
namespace {

/// The squared peaks of some cells: of the von Mises stress, and of the largest principal strain.
template <int dim>
struct SquaredPeaks {
  explicit SquaredPeaks(int n_positions)
      : von_mises(n_positions, 0.0), places(n_positions, Vec<dim>{}), principal(n_positions, 0.0) {}

  void add(const SquaredPeaks& other) {
    for (size_t i = 0; i < von_mises.size(); ++i) {
      if (other.von_mises[i] > von_mises[i]) {
        von_mises[i] = other.von_mises[i];
        places[i] = other.places[i];
      }
      principal[i] = std::max(principal[i], other.principal[i]);
    }
  }

  std::vector<double> von_mises;
  std::vector<Vec<dim>> places;
  std::vector<double> principal;
};

/// Compares squares first: computes roots only if the current peak may be exceeded.
template <int dim>
double larger_squared_principal(double so_far, const double* strain, double axial) {
  double square = 0;
  for (int k = 0; k < dim; ++k) square += strain[k] * strain[k];
  for (int k = dim; k < n_strains<dim>; ++k) square += 0.5 * strain[k] * strain[k];
  if (std::max(square, axial * axial) <= so_far) return so_far;  // e_1^2 <= e:e
  for (const double e : principal_strains<dim>(strain, axial)) so_far = std::max(so_far, e * e);
  return so_far;
}

/// Strains of all load cases and points of a cell as in Displacement::strains(), one row per load case and
/// point in it, one column per component.
template <int dim>
Matrix strains_by_component(const Matrix& strains) {
  const int n_points = strains.rows() / n_strains<dim>;
  Matrix result(strains.columns() * n_points, n_strains<dim>);
  for (int j = 0; j < strains.columns(); ++j)
    for (int q = 0; q < n_points; ++q)
      for (int k = 0; k < n_strains<dim>; ++k)
        result(j * n_points + q, k) = strains(q * n_strains<dim> + k, j);
  return result;
}

/// One cell in all positions and sectors.
template <int dim>
void add_cell(const StateSolver<dim>& solver, const Displacement<dim>& displacement, int cell,
              const std::vector<Vec<dim>>& points, SquaredPeaks<dim>& peaks) {
  const PolarGrid<dim>& grid = solver.model().grid;
  const MaterialLaw<dim>& law = solver.model().materials.in_row(grid, grid.cell_position(cell)[0]);
  const Matrix by_case = displacement.strains(cell, points).by_rows(),
               strains = strains_by_component<dim>(by_case);
  const auto columns = strain_columns<dim>(strains, 0);
  std::vector<double> squares(strains.rows()), axial_stresses(dim == 2 ? strains.rows() : 0),
      axial_strains(strains.rows());
  law.squared_von_mises(columns, squares);
  if (dim == 2) law.along_axle(columns, axial_stresses, axial_strains);
  const int n_points = static_cast<int>(points.size());
  for (int j = 0; j < by_case.columns(); ++j) {
    const int position = j / grid.n_sectors;
    for (int q = 0; q < n_points; ++q) {
      const int i = j * n_points + q;
      if (squares[i] > peaks.von_mises[position]) {
        peaks.von_mises[position] = squares[i];
        peaks.places[position] = place_in_body<dim>(grid, cell, points[q], j % grid.n_sectors);
      }
      peaks.principal[position] = larger_squared_principal<dim>(
          peaks.principal[position], by_case.column(j) + q * n_strains<dim>, axial_strains[i]);
    }
  }
}

/// The quadrature points of the cells with material, by cell; empty for the others.
template <int dim>
std::vector<std::vector<Vec<dim>>> material_points(const CutDomain<dim>& domain, int degree) {
  std::vector<std::vector<Vec<dim>>> result(domain.grid.n_cells());
  MaterialRule<dim>(domain, degree + 1)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        for (const auto& point : points) result[cell].push_back(point.xi);
      });
  return result;
}

}  // namespace

template <>
std::array<double, 3> principal_strains<2>(const double* strain, double axial_strain) {
  const double mean = 0.5 * (strain[0] + strain[1]);
  const double radius = 0.5 * std::hypot(strain[0] - strain[1], strain[2]);
  return {mean + radius, mean - radius, axial_strain};
}

template <>
std::array<double, 3> principal_strains<3>(const double* strain, double) {
  return principal_values(
      {strain[0], strain[1], strain[2], 0.5 * strain[3], 0.5 * strain[4], 0.5 * strain[5]});
}

template <int dim>
std::vector<StrainPeaks<dim>> strain_peaks_by_layer(const StateSolver<dim>& solver, const State<dim>& state) {
  const Displacement<dim>& displacement = state.displacement();
  const PolarGrid<dim>& grid = solver.model().grid;
  const Materials<dim>& materials = solver.model().materials;
  using OfLayers = std::vector<SquaredPeaks<dim>>;
  const OfLayers none(materials.layers().size(), SquaredPeaks<dim>(state.positions().size()));
  const auto points = material_points(state.domain(), solver.model().degree);
  std::vector<OfLayers> of_column(grid.columns(), none);
  const int cells_per_column = grid.n_cells() / grid.columns();
  parallel_for(grid.columns(), [&](int column) {
    for (int k = 0; k < cells_per_column; ++k) {
      const int cell = column * cells_per_column + k;
      if (points[cell].empty()) continue;
      const int layer = materials.layer_at(grid.middle_of_row(grid.cell_position(cell)[0]));
      add_cell<dim>(solver, displacement, cell, points[cell], of_column[column][layer]);
    }
  });
  std::vector<StrainPeaks<dim>> result;
  for (std::size_t layer = 0; layer < none.size(); ++layer) {
    SquaredPeaks<dim> all = none[layer];
    for (const OfLayers& peaks : of_column) all.add(peaks[layer]);
    for (double& square : all.von_mises) square = std::sqrt(square);
    for (double& square : all.principal) square = std::sqrt(square);
    result.push_back({std::move(all.von_mises), std::move(all.places), std::move(all.principal)});
  }
  return result;
}

template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state) {
  auto by_layer = strain_peaks_by_layer(solver, state);
  StrainPeaks<dim> all = std::move(by_layer.front());
  for (auto layer = by_layer.begin() + 1; layer != by_layer.end(); ++layer)
    for (std::size_t i = 0; i < all.von_mises.size(); ++i) {
      if (layer->von_mises[i] > all.von_mises[i]) {
        all.von_mises[i] = layer->von_mises[i];
        all.von_mises_places[i] = layer->von_mises_places[i];
      }
      all.principal[i] = std::max(all.principal[i], layer->principal[i]);
    }
  return all;
}

template decltype(strain_peaks_by_layer<2>) strain_peaks_by_layer<2>;
template decltype(strain_peaks_by_layer<3>) strain_peaks_by_layer<3>;
template decltype(strain_peaks<2>) strain_peaks<2>;
template decltype(strain_peaks<3>) strain_peaks<3>;

}  // namespace wheelwright
