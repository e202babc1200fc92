#pragma once

#include <array>
#include <span>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/mechanics/elasticity/ghost_penalty.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

/// The element of a scalar field on one cell, of degree 1 or 2. Its unknowns are the values at the nodes of
/// the cell. Places and gradients are in the Cartesian frame of the cell: its first axis is radial at the
/// first azimuth of the cell.
template <int dim>
class ScalarElement {
 public:
  static constexpr int max_nodes = power(3, dim);

  ScalarElement(const PolarGrid<dim>& grid, int degree, const std::array<int, dim>& cell)
      : degree_(degree), map_(grid, degree, cell) {}

  int degree() const { return degree_; }
  int n_nodes() const { return nodes_per_cell<dim>(degree_); }

  /// Linear maps from the unknowns to the field and its gradient at a point of the unit cell.
  struct Point {
    Vec<dim> position;  ///< in the frame of the cell
    Mat<dim> jacobian;
    double determinant;
    std::array<double, max_nodes> value;
    std::array<Vec<dim>, max_nodes> gradient;
  };
  Point at(const Vec<dim>& xi) const;

  /// The second derivative across a face normal to `axis` as a linear map of the unknowns, with `n` and the
  /// direction as in ElasticElement::second_derivative().
  std::array<double, max_nodes> second_derivative(const Vec<dim>& xi, int axis, const Vec<dim>& n) const;

 private:
  int degree_;
  CellMap<dim> map_;
};

// Forms on the nodes of a cell, full symmetric matrices.

/// int grad a . grad b over the material that the points integrate.
template <int dim>
Matrix gradient_form(const ScalarElement<dim>& element, std::span<const ReferencePoint<dim>> points);

/// int a b over the same.
template <int dim>
Matrix mass_form(const ScalarElement<dim>& element, std::span<const ReferencePoint<dim>> points);

/// int a b over the surface that the points integrate.
template <int dim>
Matrix surface_form(const ScalarElement<dim>& element, std::span<const ReferenceSurfacePoint<dim>> points);

/// The jumps across a face on the nodes (minus cell, plus cell), as in ghost_stiffness(): 1/2 int_F xi h
/// [[d_n a]] [[d_n b]], and with GhostPenaltyKind::full and degree 2 also 1/2 int_F xi h^3 [[d_mm a]] [[d_mm
/// b]]. `h`: the size of the cells across the face [m]; `angle`: the azimuth of the frame of the plus cell
/// minus that of the minus cell [rad].
template <int dim>
Matrix jump_form(const ScalarElement<dim>& minus, const ScalarElement<dim>& plus, int axis, double angle,
                 double h, const GhostPenalty& ghost);

/// The quadrature of a whole face of the unit cell, normal to `axis`, at its first (0) or last (1) end.
template <int dim>
std::vector<ReferenceSurfacePoint<dim>> face_rule(int axis, int end, int points);

/// The quadrature of the material's part of a cut cell's face normal to the axle, by the divergence theorem
/// from that of the cell: exact for what that integrates exactly. Weights may be negative.
std::vector<ReferenceSurfacePoint<3>> side_face_rule(const CutCell<3>& cut, int end);

}  // namespace wheelwright
