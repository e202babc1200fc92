#pragma once

#include <array>
#include <cmath>
#include <span>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/mechanics/elasticity/dilatation.h"
#include "wheelwright/mechanics/elasticity/ghost_penalty.h"
#include "wheelwright/mechanics/elasticity/material_law.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {

/// The traction sigma n.
template <int dim>
Vec<dim> traction(const Voigt<dim>& stress, const Vec<dim>& normal);

/// The displacement element of the cells in one row of the grid, which have the same material. Its dofs are
/// the nodal displacements in the polar components (radial, azimuthal[, axial]) at each node, numbered by
/// dof(). All results are in the Cartesian frame of the cell: its first axis is radial at the first azimuth
/// of the cell. Only strains are in polar axes at their point if the law has such axes.
///
/// If the dilatation is projected, most of the bulk modulus of the element of degree 2 works on div u
/// projected in L2 on the linear functions of x, on the part of the cell that is material: the mixed element
/// of quadratic displacement and discontinuous, linear pressure, which does not lock, with its pressure
/// eliminated. A small part works on div u itself, without which stresses at edges of holes are less accurate
/// (docs/method.md).
template <int dim>
class ElasticElement {
 public:
  static constexpr int max_nodes = power(3, dim);
  static constexpr int max_dofs = dim * max_nodes;

  /// `cell` is a position on the grid; its azimuthal part does not matter. The dilatation is projected only
  /// if the degree is 2 and the law isotropic. Forms and tractions of the element take the same law.
  ElasticElement(const PolarGrid<dim>& grid, int degree, const std::array<int, dim>& cell,
                 const MaterialLaw<dim>& law, DilatationKind dilatation = DilatationKind::automatic);

  int degree() const { return degree_; }
  int n_nodes() const { return nodes_per_cell<dim>(degree_); }
  int n_dofs() const { return dim * n_nodes(); }
  static constexpr int dof(int node, int component) { return dim * node + component; }
  /// h_T, the maximum distance of two corners in the plane of the wheel [m]: contact and ghost penalty are
  /// the same however long the cells are along the axle.
  double plane_diameter() const { return plane_diameter_; }
  /// The size of the cell across its faces normal to an axis, for the ghost penalty there [m]: h_T, or along
  /// the axle the cell's length.
  double size_across(int axis) const { return axis == 2 ? axial_length_ : plane_diameter_; }

  /// Linear maps from the dofs of the cell to the fields at one point of the unit cell. There is one column
  /// per dof.
  struct Point {
    Vec<dim> position;  ///< x in the frame of the cell
    Mat<dim> jacobian;
    double determinant;
    std::array<std::array<double, max_dofs>, n_strains<dim>> strain;  ///< rows: Voigt components for the law
    std::array<std::array<double, max_dofs>, dim> displacement;       ///< rows: components
    std::array<double, max_dofs> dilatation;                          ///< div u, never projected
  };
  /// With a strain whose trace gives the pressure: where projected_lambda() works on it, div u is projected
  /// on the whole cell, also where the cell is cut.
  Point at(const Vec<dim>& xi) const;
  /// With the strain of u itself.
  Point with_own_strain(const Vec<dim>& xi) const;

  /// Whether strains are in polar axes.
  bool has_polar_strains() const { return has_polar_strains_; }
  /// The azimuth of the first axis of strains at a place, both in the frame of the cell [rad]: 0, or that of
  /// the place.
  double azimuth_of_strains(const Vec<dim>& position) const {
    return has_polar_strains_ ? std::atan2(position[1], position[0]) : 0;
  }

  /// The gradient of u: du_i / dx_j in row dim * i + j.
  std::array<std::array<double, max_dofs>, dim * dim> gradient(const Vec<dim>& xi) const;

  /// The second derivative d^2 u / dm^2 across a face, as a linear map of the dofs (rows: components of u):
  /// m is along the grid's line through the point that crosses the face, normal to `axis`, and its component
  /// along the face's unit normal n is 1.
  std::array<std::array<double, max_dofs>, dim> second_derivative(const Vec<dim>& xi, int axis,
                                                                  const Vec<dim>& n) const;

  /// The part of lambda that works on the projected dilatation; 0 if there is none [Pa].
  double projected_lambda() const { return projected_lambda_; }
  bool projects_dilatation() const { return projected_lambda_ > 0; }

  /// The linear functions of x, on which div u is projected: 1 and the components of (x - x_c) / h_T, with
  /// x_c the middle of the cell.
  std::array<double, dim + 1> linear_functions(const Vec<dim>& x) const;

  /// The coefficients, on the linear functions, of div u projected on a part of the cell, which is given by
  /// quadrature points; one column a dof.
  Matrix project_dilatation(std::span<const ReferencePoint<dim>> part) const;

 private:
  int degree_;
  bool has_polar_strains_;
  CellMap<dim> map_;
  std::array<Mat<dim>, max_nodes> frames_;  ///< polar to Cartesian components at each node
  double plane_diameter_, axial_length_ = 0;
  double projected_lambda_ = 0;
  double projected_share_ = 0;  ///< of the bulk modulus
  Matrix dilatation_;  ///< coefficients of div u projected on the whole cell; empty if it is not projected
};

/// The integrals that project div u on a part of a cell.
template <int dim>
struct DilatationMoments {
  Matrix mass = Matrix(dim + 1, dim + 1);  ///< of the linear functions times each other
  Matrix of_dofs;                          ///< of the linear functions times div u, one column a dof

  explicit DilatationMoments(int n_dofs) : of_dofs(dim + 1, n_dofs) {}

  void add(const ElasticElement<dim>& element, const typename ElasticElement<dim>::Point& point,
           double weight);
  /// Of the projected div u; 0 if the part has no volume.
  Matrix coefficients() const;
};

/// The traction sigma n as a linear map of the dofs (rows: components); all in the frame of the cell.
template <int dim>
std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> traction_map(
    const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
    const typename ElasticElement<dim>::Point& point, const Vec<dim>& normal);

/// The bulk stiffness, the integral of sigma(u) : eps(v) by the given quadrature points, as a full symmetric
/// matrix on the dofs of the cell.
template <int dim>
Matrix cell_stiffness(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                      std::span<const ReferencePoint<dim>> points);

/// E times the integral of grad u : grad v, with E = MaterialLaw::scaling_modulus(), in place of the bulk
/// stiffness: every Cartesian component of u obeys Poisson's equation.
template <int dim>
Matrix gradient_stiffness(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                          std::span<const ReferencePoint<dim>> points);

/// The ghost penalty of one face F on the dofs (minus cell, plus cell): 1/2 int_F xi h_F / E [[sigma
/// n]].[[sigma n]] as in (81), and for GhostPenaltyKind::full also 1/2 int_F xi h_F^3 E [[d_mm u]].[[d_mm
/// u]] with m as in second_derivative() and the strain of u itself, where h_F is the mean size_across(axis)
/// of the two cells and E is MaterialLaw::scaling_modulus(). `axis` is the axis normal to the face, and
/// `angle` is the azimuth of the frame of the plus cell minus that of the minus cell [rad].
template <int dim>
Matrix ghost_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                       double angle, const MaterialLaw<dim>& law, const GhostPenalty& ghost);

/// The penalty of the traction's jump alone, with the given weight for xi and with the strains that carry the
/// load, whose trace is projected where the material asks for it.
template <int dim>
Matrix traction_jump_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                               double angle, const MaterialLaw<dim>& law, double weight);

/// The ghost penalty of a face normal to the azimuth as a sum of two forms, each on the dofs of one of its
/// cells and on derivatives of u across the face, which are unknowns of their own: the minimum of the sum
/// over all derivatives, polynomials on the face that are continuous along it, is ghost_stiffness(). So the
/// cells on both sides share nothing but values and derivatives on the face. The dofs of the derivatives come
/// after those of the cell: at the nodes of the face in the cell's order, with respect to the coordinate of
/// the unit cell, in polar components at the face; the first derivative, then the second if
/// n_compared_derivatives() is 2.
struct GhostHalves {
  Matrix minus, plus;
};
template <int dim>
GhostHalves divided_ghost_stiffness(const ElasticElement<dim>& element, double column_angle,
                                    const MaterialLaw<dim>& law, const GhostPenalty& ghost);

/// A form on the dofs of two cells (minus, plus) side by side along the axle, for fields that are their own
/// mirror image in the face between them: the half of it that belongs to the minus cell, on the dofs of that
/// cell.
Matrix half_of_symmetric_pair(const Matrix& form, int degree);

}  // namespace wheelwright
