#pragma once

#include "wheelwright/mechanics/state/load_positions.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The moving boundary in one cell, each of its points as often as it counts, and the material of the cell.
template <int dim>
struct CellBoundary {
  int cell;
  std::vector<ReferenceSurfacePoint<dim>> rule;
  std::vector<ReferencePoint<dim>> material;
  std::vector<ReferenceEdgePoint<dim>> edges;
};

/// The cells in which gradients are given for one cut cell: it alone; or it and its image, when positions
/// stand for their images too; nothing for the image itself.
template <int dim>
std::vector<CellBoundary<dim>> cells_of(const CutDomain<dim>& domain, const LoadPositions& positions,
                                        const CutCell<dim>& cut);

/// The points at which shape gradients are given: those of the cut cells' quadrature. When positions stand
/// for their mirror images, the points of a cell are the images of those of its image. `degree`: of the
/// displacement.
template <int dim>
std::vector<SurfacePoint<dim>> moving_boundary_points(const CutDomain<dim>& domain, int degree,
                                                      const LoadPositions& positions);

/// Values of functions, [function][point].
using ByFunction = std::vector<std::vector<double>>;

/// The densities in the cells of one cut cell, [function][point]. Where positions stand for their images too,
/// both are the mean of what the positions give in the one and in the other.
template <int dim, class InCell>
ByFunction in_cells(const std::vector<CellBoundary<dim>>& cells, const InCell& in_cell) {
  if (cells.empty()) return {};
  ByFunction result = in_cell(cells[0]);
  if (cells.size() == 1) return result;
  const ByFunction images = in_cell(cells[1]);
  for (size_t f = 0; f < result.size(); ++f) {
    const size_t n = result[f].size();
    for (size_t q = 0; q < n; ++q) result[f][q] = (result[f][q] + images[f][q]) / 2;
    for (size_t q = 0; q < n; ++q) result[f].push_back(result[f][q]);
  }
  return result;
}

/// One cell's after the other.
ByFunction joined(size_t n_functions, const std::vector<ByFunction>& of_cells);

}  // namespace wheelwright
