#pragma once

#include <optional>
#include <span>

#include "wheelwright/shape/cut/bernstein.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// Splits unit cells along the zero set of their polynomial level set. In 3D, cells along one axis of which
/// it does not change, as in bodies of revolution and extruded ones, are prisms of the plane's cells.
template <int dim>
class CellQuadrature {
  friend class CellQuadrature<3>;

 public:
  /// `points` Gauss points a direction on every smooth piece; in 2D two more along the bases of a cell's
  /// columns, where integrands are not polynomials. `degree`: 1 or 2, that of the level set.
  CellQuadrature(int degree, int points);

  /// Sign pattern of a cell's polynomial from its Bernstein coefficients: `inside` and `outside` are certain,
  /// `cut` means that the zero set may cross the cell.
  CellKind classify(std::span<const double> nodal_values) const;

  /// Quadrature of a cell whose classify() is `cut`; its parts may be empty. Nothing if a value is not
  /// finite, or if the parts are inconsistent and the quadrature would be wrong. Mirror images of a cell's
  /// values give the mirror images of its points, up to rounding. In 2D the boundary is divided where it
  /// passes the lines through the level set's nodes, so that functions with kinks there are integrated as
  /// well.
  std::optional<CutCell<dim>> split(int cell, std::span<const double> nodal_values) const;

  /// The error in the divergence theorem for material, boundary and the material's part of the cell's faces,
  /// with the unit vectors and the position; the faces are integrated independently. NaN if that fails.
  double divergence_defect(const CutCell<dim>& cell, std::span<const double> nodal_values) const;

 private:
  /// Measure of the material on the face at an end, 0 or 1, of an axis.
  double face_measure(std::span<const double> nodal_values, int axis, int end) const;
  void append(std::span<const double> nodal_values, CutCell<dim>& result) const;

  int degree_;
  GaussRule rule_;
  GaussRule base_rule_;              ///< for the bases of 2D columns, where integrands are not polynomials
  std::vector<double> inner_nodes_;  ///< of the level set, on an axis
};

}  // namespace wheelwright
