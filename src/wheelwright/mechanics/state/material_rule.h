#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

/// The quadrature of integrals over the material of one sector, tread included, in the cells of the grid.
template <int dim>
class MaterialRule {
 public:
  /// With so many Gauss points per direction in full cells.
  MaterialRule(const CutDomain<dim>& domain, int n_points)
      : domain_(domain), full_(unit_cell_rule<dim>(n_points)) {}

  struct Cell {
    int cell;
    std::span<const ReferencePoint<dim>> points;
  };
  /// The cells that contain material.
  std::vector<Cell> cells() const {
    std::vector<Cell> cells;
    for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> points) {
      cells.push_back({cell, points});
    });
    return cells;
  }

  /// Calls visit(cell, points) for every cell that contains material.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    auto cut = domain_.cut.begin();
    for (int cell = 0; cell < domain_.grid.n_cells(); ++cell) {
      const bool is_cut = cut != domain_.cut.end() && cut->cell == cell;
      const std::span<const ReferencePoint<dim>> points = is_cut ? (cut++)->material : full_;
      if (domain_.active(cell) && !points.empty()) visit(cell, points);
    }
  }

 private:
  const CutDomain<dim>& domain_;
  std::vector<ReferencePoint<dim>> full_;
};

/// Quadrature points of a cell.
template <int dim>
struct WeightedPoints {
  std::vector<Vec<dim>> points;  ///< of the unit cell
  std::vector<double> weights;   ///< [m^2, or m^3 when dim = 3]
};

/// For a displacement of that degree.
template <int dim>
WeightedPoints<dim> weighted_points(const PolarGrid<dim>& grid, int degree, int cell,
                                    std::span<const ReferencePoint<dim>> points) {
  const CellMap<dim> map(grid, degree, grid.cell_position(cell));
  WeightedPoints<dim> result;
  for (const auto& point : points) {
    result.points.push_back(point.xi);
    result.weights.push_back(point.weight *
                             determinant<dim>(map.jacobian(ShapeFunctions<dim>(degree, point.xi))));
  }
  return result;
}

}  // namespace wheelwright
