#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/geometry/gauss.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

enum class CellKind : std::uint8_t { outside, cut, inside };

/// A quadrature point of {psi = 0} in the unit cell.
template <int dim>
struct ReferenceSurfacePoint {
  Vec<dim> xi;
  Vec<dim> normal;  ///< unit normal along the gradient of psi in the coordinates of the unit cell, out of the
                    ///< material
  double weight;    ///< length (or area) in the coordinates of the unit cell
};

/// A quadrature point of the edge in which {psi = 0} meets a side face of the wheel, in the unit cell.
template <int dim>
struct ReferenceEdgePoint {
  Vec<dim> xi;
  Vec<dim> normal;  ///< of {psi = 0}, as in ReferenceSurfacePoint
  double outward;   ///< component along the axle of the side face's unit normal out of the wheel: 1 or -1
  double weight;    ///< length in the coordinates of the unit cell
};

/// Quadrature of one cell that the boundary crosses. It integrates over the zero set of the polynomial
/// itself; its order is that of the one-dimensional Gauss rule.
template <int dim>
struct CutCell {
  int cell;
  std::vector<ReferencePoint<dim>> material;         ///< over {psi < 0} in the unit cell
  std::vector<ReferenceSurfacePoint<dim>> boundary;  ///< over {psi = 0} in the unit cell
  std::vector<ReferenceEdgePoint<dim>> edges = {};   ///< where dim = 3 and the cell is at a side face
};

/// An interior face between two active cells of which at least one is cut. `plus` is the next cell after
/// `minus` along `axis`. If axis = 1 and `minus` is in the last column, `plus` belongs to the next sector. In
/// half a wheel, `plus` is `minus` itself where the next cell along the axle (axis = 2) is its mirror image.
struct GhostFace {
  int minus, plus;
  int axis;
  bool crossed;  ///< whether the boundary crosses the face itself, as for the faces of (81)
};

/// The cells of one sector classified as inside, cut or outside the material, with the quadrature of the cut
/// cells.
template <int dim>
struct CutDomain {
  PolarGrid<dim> grid;
  std::vector<CellKind> kinds;    ///< one per cell of the sector
  std::vector<CutCell<dim>> cut;  ///< in ascending order of the cells
  std::vector<GhostFace> ghost_faces;

  /// Whether the cell contains material.
  bool active(int cell) const { return kinds[cell] != CellKind::outside; }
};

/// Classifies the cells of psi's grid and builds the cut quadrature with `points` Gauss points per direction.
/// Fails with cut_quadrature if the quadrature of a cell does not satisfy the divergence theorem, and with
/// not_finite.
template <int dim>
Expected<CutDomain<dim>> cut_domain(const LevelSet<dim>& psi, int points);

/// The cells before the middle of the width, of a mirror-symmetric domain with an even number of cells along
/// the axle.
CutDomain<3> first_half(const CutDomain<3>& whole);

/// Checks that the shape can be computed. Returns protected_band if a cell of the innermost `rim_rows` rows
/// or of the outermost `tread_rows` rows is not full, tread_cut_off if active cells of the outermost row are
/// not connected to the rim through active cells, and disconnected_material if other active cells are not.
/// Empty if all is well.
template <int dim>
std::optional<Failure> check_attached(const CutDomain<dim>& domain, int rim_rows, int tread_rows);

}  // namespace wheelwright
