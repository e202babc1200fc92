#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheelwright/mechanics/elasticity/element.h"
#include "wheelwright/mechanics/hyperelastic/stored_energy.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

/// The element of large deformation of the cells in one row of the grid, which have the same material: total
/// Lagrangian, in the undeformed cell. Dofs and frame are those of ElasticElement: nodal displacements in
/// polar components at each node, numbered by dof(); everything else in the Cartesian frame of the cell.
///
/// Where ElasticElement projects div u, ln J is projected in L2 on the linear functions of x on the part of
/// the cell that is material, and the same part of lambda works on it:
///   W_cell = int W_kept(F) + projected_lambda/2 (pi ln J)^2 dx.
template <int dim>
class HyperelasticElement {
 public:
  static constexpr int max_nodes = ElasticElement<dim>::max_nodes, max_dofs = ElasticElement<dim>::max_dofs;
  using Dofs = std::array<double, max_dofs>;
  /// A block on the dofs of a cell, row-major with rows of n_dofs() entries.
  using Block = std::array<double, size_t(max_dofs) * max_dofs>;

  /// `small_strains`: the constants of Hooke's law for small strains.
  HyperelasticElement(const PolarGrid<dim>& grid, int degree, int row, const StoredEnergy& energy,
                      const Material& small_strains, DilatationKind dilatation = DilatationKind::automatic);

  int n_nodes() const { return linear_.n_nodes(); }
  int n_dofs() const { return linear_.n_dofs(); }
  static constexpr int dof(int node, int component) { return dim * node + component; }
  const StoredEnergy& stored_energy() const { return energy_; }
  /// The element of the same cells for small strains: their geometry, and Hooke's law.
  const ElasticElement<dim>& small_strains() const { return linear_; }
  double projected_lambda() const { return projected_lambda_; }  ///< [Pa]

  /// A point of a cell, with all that does not depend on the displacement.
  struct Point {
    double weight;      ///< dx of a quadrature point [m^2, or m^3 when dim = 3]; 0: none
    Vec<dim> position;  ///< x
    std::array<std::array<double, max_nodes>, dim> gradient;  ///< dN_a / dx_j: [j][a] [1/m]
    std::array<double, max_nodes> value;                      ///< N_a
    std::array<double, dim + 1> linear;                       ///< ElasticElement::linear_functions()
  };
  Point at(const Vec<dim>& xi, double reference_weight = 0) const;

  /// The quadrature of the material of a cell.
  struct Points {
    std::vector<Point> points;
    /// Inverse of the integrals of the linear functions times each other; empty if ln J is not projected.
    Matrix inverse_mass;
  };
  Points points(std::span<const ReferencePoint<dim>> material) const;

  /// The Cartesian components of the nodal displacements, [i][node].
  using Nodal = std::array<std::array<double, max_nodes>, dim>;
  Nodal cartesian(const double* dofs) const;
  /// Adds Cartesian forces on the nodes to forces on the dofs.
  void add_to_dofs(const Nodal& forces, double* dofs) const;

  /// F = I + du/dx.
  Mat<dim> deformation(const Point& point, const Nodal& u) const;

  /// The integral of W over the material; infinite if it is turned inside out somewhere.
  double energy(const Points& points, const double* dofs) const;

  /// The same, and its derivative with respect to the dofs, which must be n_dofs() numbers.
  double forces(const Points& points, const double* dofs, Dofs& forces) const;

  /// The same, and its second derivative, symmetric.
  double tangent(const Points& points, const double* dofs, Dofs& forces, Block& tangent) const;

  /// The projection of ln J: its coefficients on the linear functions, and their derivative with respect to
  /// the dofs, one column each. Zero if it is not projected.
  struct ProjectedVolume {
    std::array<double, dim + 1> coefficients{};
    Matrix by_dofs;  ///< empty if it is not projected

    double at(const Point& point) const {
      double sum = 0;
      for (int a = 0; a <= dim; ++a) sum += coefficients[a] * point.linear[a];
      return sum;
    }
  };
  ProjectedVolume projected_volume(const Points& points, const double* dofs) const;

  /// P and its tangent at a point, with the pressure of the projected ln J: what the tread observes.
  EnergyResponse<dim> response_at(const Point& point, const Mat<dim>& f,
                                  const ProjectedVolume& volume) const {
    return response<dim>(kept_, f, projected_lambda_ * volume.at(point));
  }
  /// W without the part that works on the projection.
  const StoredEnergy& kept() const { return kept_; }

  /// The derivative of a Piola traction P n with respect to the dofs (rows: components); `at` must be the
  /// response there.
  std::array<Dofs, dim> traction_tangent(const Point& point, const EnergyResponse<dim>& at, const Mat<dim>& f,
                                         const ProjectedVolume& volume, const Vec<dim>& normal) const;

  /// The derivative of F: P over the dofs for a tensor P, added with a factor: P : grad v.
  void add_work(const Point& point, const Mat<dim>& piola, double factor, double* dofs) const;

 private:
  ElasticElement<dim> linear_;
  CellMap<dim> map_;
  StoredEnergy energy_, kept_;
  double projected_lambda_ = 0;
  std::array<Mat<dim>, max_nodes> frames_;  ///< polar to Cartesian components at each node
};

/// The ghost penalty of one face F for large deformation on the dofs (minus cell, plus cell): 1/2 int_F xi
/// h_F E [[du/dn]].[[du/dn]], and for GhostPenaltyKind::full also 1/2 int_F xi h_F^3 E [[d_mm u]].[[d_mm u]],
/// as ghost_stiffness() with the derivative of u in place of the traction: a superposed rotation of the
/// deformed wheel does not change it. `modulus`: E [Pa].
template <int dim>
Matrix gradient_ghost_stiffness(const ElasticElement<dim>& minus, const ElasticElement<dim>& plus, int axis,
                                double angle, double modulus, const GhostPenalty& ghost);

}  // namespace wheelwright
