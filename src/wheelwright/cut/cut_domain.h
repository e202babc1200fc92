#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/geometry/gauss.h"
#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

enum class CellKind : std::uint8_t { outside, cut, inside };

/// A quadrature point of {psi = 0} in the unit cell.
template <int dim>
struct ReferenceSurfacePoint {
  Vec<dim> xi;
  Vec<dim> normal;  ///< unit, along the gradient of psi in the unit cell's coordinates: out of the material
  double weight;    ///< measure in the unit cell's coordinates
};

/// Quadrature of one cell that the boundary crosses, exact for the piecewise polynomial level set up to the
/// order of the one-dimensional rule.
template <int dim>
struct CutCell {
  int cell;
  std::vector<ReferencePoint<dim>> material;         ///< over {psi < 0} in the unit cell
  std::vector<ReferenceSurfacePoint<dim>> boundary;  ///< over {psi = 0} in the unit cell
};

/// An interior face between two active cells, at least one of them cut. `plus` lies behind `minus` along
/// `axis`; when axis = 1 and `minus` is in the last column, `plus` belongs to the next sector.
struct GhostFace {
  int minus, plus;
  int axis;
  bool crossed;  ///< the boundary crosses this very face: the faces of (81)
};

/// Where the material is on one sector's grid: which cells are inside, cut or outside, and how to integrate.
template <int dim>
struct CutDomain {
  PolarGrid<dim> grid;
  std::vector<CellKind> kinds;    ///< one a cell of the sector
  std::vector<CutCell<dim>> cut;  ///< ascending cell numbers
  std::vector<GhostFace> ghost_faces;

  bool active(int cell) const { return kinds[cell] != CellKind::outside; }
};

/// Classifies the cells of psi's grid and builds the cut quadrature with `points` Gauss points a direction.
/// Fails with cut_quadrature (a cell misses the divergence theorem) or not_finite.
template <int dim>
Expected<CutDomain<dim>> cut_domain(const LevelSet<dim>& psi, int points);

/// Whether the shape can be computed with: fails with protected_band when a cell of the innermost `rim_rows`
/// or outermost `tread_rows` rows is not full, with tread_cut_off when the outermost row is not reached from
/// the rim through active cells, and with disconnected_material when another active cell is not.
template <int dim>
std::optional<Failure> check_attached(const CutDomain<dim>& domain, int rim_rows, int tread_rows);

}  // namespace wheelwright
