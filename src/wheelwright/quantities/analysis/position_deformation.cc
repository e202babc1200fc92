#include "wheelwright/quantities/analysis/position_deformation.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {
namespace {

/// Sums over the points of some cells in one load position, all sectors.
struct PointSums {
  ExpandedEnergy energy;
  double squared_strain = 0;    ///< eps:eps, times the linear energy
  double largest_rotation = 0;  ///< its square

  PointSums& operator+=(const PointSums& other) {
    energy += other.energy;
    squared_strain += other.squared_strain;
    largest_rotation = std::max(largest_rotation, other.largest_rotation);
    return *this;
  }
};

template <int dim>
double squared_norm(const Voigt<dim>& strain) {
  double square = 0;
  for (int k = 0; k < n_strains<dim>; ++k) square += (k < dim ? 1 : 0.5) * strain[k] * strain[k];
  return square;
}

/// A cell of the sector with the points of its material.
template <int dim>
struct MaterialCell {
  int cell;
  WeightedPoints<dim> quadrature;
};

/// The cells with material, in every column of the sector.
template <int dim>
std::vector<std::vector<MaterialCell<dim>>> material_cells(const RollingModel<dim>& model,
                                                           const CutDomain<dim>& domain) {
  const PolarGrid<dim>& grid = model.grid;
  std::vector<std::vector<MaterialCell<dim>>> columns(grid.columns());
  MaterialRule<dim>(domain, model.degree + 1)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
        columns[grid.cell_position(cell)[1]].push_back(
            {cell, weighted_points(grid, model.degree, cell, points)});
      });
  return columns;
}

/// Adds a cell in all positions and sectors.
template <int dim>
void add_cell(const StateSolver<dim>& solver, const Displacement<dim>& displacement,
              const MaterialCell<dim>& cell, std::vector<PointSums>& sums) {
  constexpr int n_values = n_strains<dim> + n_rotations<dim>;
  const PolarGrid<dim>& grid = solver.model().grid;
  const std::vector<Vec<dim>>& points = cell.quadrature.points;
  const MaterialLaw<dim>& law = solver.model().materials.in_row(grid, grid.cell_position(cell.cell)[0]);
  const Matrix values = displacement.strains_and_rotations(cell.cell, points).by_load_case();
  Matrix stresses(values.rows(), n_strains<dim>);
  for (std::size_t q = 0; q < points.size(); ++q) {
    const int first = n_values * static_cast<int>(q);
    law.stress(strain_columns<dim>(values, first), stress_columns<dim>(stresses, 0));
    for (int j = 0; j < values.rows(); ++j) {
      Voigt<dim> stress, strain;
      Vec<n_rotations<dim>> rotation;
      for (int k = 0; k < n_strains<dim>; ++k) {
        stress[k] = stresses(j, k);
        strain[k] = values(j, first + k);
      }
      for (int k = 0; k < n_rotations<dim>; ++k) rotation[k] = values(j, first + n_strains<dim> + k);
      const ExpandedEnergy energy =
          cell.quadrature.weights[q] * expanded_energy<dim>(stress, strain, rotation);
      sums[j / grid.n_sectors] +=
          PointSums{energy, energy.linear * squared_norm<dim>(strain), dot(rotation, rotation)};
    }
  }
}

PositionDeformation deformation(const PointSums& sums) {
  const auto root_mean = [&](double sum) { return std::sqrt(sum / sums.energy.linear); };
  return {.largest_rotation = std::sqrt(sums.largest_rotation),
          .root_mean_strain = root_mean(sums.squared_strain),
          .root_mean_rotation = root_mean(sums.energy.of_bending),
          .neglected = linear_theory_error(sums.energy)};
}

}  // namespace

template <int dim>
std::vector<PositionDeformation> position_deformations(const StateSolver<dim>& solver,
                                                       const State<dim>& state) {
  const Displacement<dim>& displacement = state.displacement();
  const auto columns = material_cells(solver.model(), state.domain());
  const std::vector<PointSums> none(state.positions().size());
  std::vector<std::vector<PointSums>> of_column(columns.size(), none);
  parallel_for(static_cast<int>(columns.size()), [&](int column) {
    for (const auto& cell : columns[column]) add_cell(solver, displacement, cell, of_column[column]);
  });
  std::vector<PositionDeformation> result;
  for (std::size_t i = 0; i < none.size(); ++i) {
    PointSums sums;
    for (const auto& of : of_column) sums += of[i];
    result.push_back(deformation(sums));
    if (!solver.model().materials.are_linear()) result.back().neglected = {};
  }
  return result;
}

template decltype(position_deformations<2>) position_deformations<2>;
template decltype(position_deformations<3>) position_deformations<3>;

}  // namespace wheelwright
