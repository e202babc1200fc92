#pragma once

#include <array>
#include <span>

#include "wheelwright/elasticity/ghost_penalty.h"
#include "wheelwright/elasticity/material.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/gauss.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// Independent components of a symmetric tensor: (11, 22, 12) or (11, 22, 33, 23, 13, 12); shear strains are
/// engineering strains 2 e_ij.
template <int dim>
constexpr int n_strains = dim*(dim + 1) / 2;

/// A stress or strain in that order.
template <int dim>
using Voigt = std::array<double, n_strains<dim>>;

/// sigma(eps) of (2), in Voigt notation.
template <int dim>
Voigt<dim> stress(const Material& material, const Voigt<dim>& strain);

/// sigma n.
template <int dim>
Vec<dim> traction(const Voigt<dim>& stress, const Vec<dim>& normal);

/// sqrt(3/2 s:s) of the stress; for dim = 2 with the out-of-plane stress of plane strain.
template <int dim>
double von_mises(const Material& material, const Voigt<dim>& stress);

/// A displacement cell of one row of the grid. Its dofs are the nodal displacements in each node's own polar
/// components (radial, azimuthal[, axial]), local node major: dof = dim * node + component. All results are
/// in the cell's frame: Cartesian axes, the first radial at the cell's first azimuth.
template <int dim>
class ElasticElement {
 public:
  static constexpr int max_nodes = power(3, dim);
  static constexpr int max_dofs = dim * max_nodes;

  /// `cell` is a position on the grid; its azimuth does not matter.
  ElasticElement(const PolarGrid<dim>& grid, int degree, const std::array<int, dim>& cell);

  int degree() const { return degree_; }
  int n_nodes() const { return nodes_per_cell<dim>(degree_); }
  int n_dofs() const { return dim * n_nodes(); }
  double diameter() const { return diameter_; }  ///< h_T, the largest distance of two corners [m]

  /// Linear maps from the cell's dofs at one point of the unit cell.
  struct Point {
    Vec<dim> position;  ///< x, in the cell's frame
    Mat<dim> jacobian;
    double determinant;
    std::array<std::array<double, max_dofs>, n_strains<dim>> strain;  ///< rows: Voigt strain
    std::array<std::array<double, max_dofs>, dim> displacement;       ///< rows: displacement
  };
  Point at(const Vec<dim>& xi) const;

  /// d^2 u / dn^2 as a linear map (rows: components) for a unit vector n.
  std::array<std::array<double, max_dofs>, dim> second_derivative(const Vec<dim>& xi,
                                                                  const Vec<dim>& n) const;

 private:
  int degree_;
  CellMap<dim> map_;
  std::array<Mat<dim>, max_nodes> frames_;  ///< polar to Cartesian components at every node
  double diameter_;
};

/// sigma n as a linear map of the dofs (rows: components).
template <int dim>
std::array<std::array<double, ElasticElement<dim>::max_dofs>, dim> traction_map(
    const ElasticElement<dim>& element, const Material& material,
    const typename ElasticElement<dim>::Point& point, const Vec<dim>& normal);

/// Integral of A eps(u) : eps(v) over the points, as a full symmetric matrix on the cell's dofs.
template <int dim>
Matrix cell_stiffness(const ElasticElement<dim>& element, const Material& material,
                      std::span<const ReferencePoint<dim>> points);

/// One face's term of (81), 1/2 int_F xi h_F / E [[sigma n]].[[sigma n]], and for GhostPenaltyKind::full also
/// 1/2 int_F xi h_F^3 E [[d_nn u]].[[d_nn u]], on the dofs (minus cell, plus cell); h_F is the mean diameter
/// of the two cells. `angle` is the azimuth of the plus cell's frame less the minus cell's; `axis` the
/// face's.
template <int dim>
Matrix ghost_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                       double angle, const Material& material, const GhostPenalty& ghost);

}  // namespace wheelwright
