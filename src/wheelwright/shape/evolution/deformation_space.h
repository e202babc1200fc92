#pragma once

#include <span>
#include <vector>

#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/shape/evolution/boundary_motion.h"
#include "wheelwright/shape/geometry/invariance.h"

namespace wheelwright {

/// Deformations of a sector. They are multilinear between the nodes of the lattice, vanish at some of them,
/// may have to be invariant (Invariance), and have one component after the other, each at all nodes. A load
/// is a linear function of the deformation, with as many values. The inner product is (t, w) = sum over the
/// components d of int length^2 grad t_d . grad w_d + t_d w_d over one sector.
///
/// The edges of a thin wall have opposite normals. A smooth vector field moves the wall as a whole, which
/// changes its stiffness little; a smooth speed moves its edges apart. If deformations are vectors, speeds at
/// the nodes differ from those of the boundary where it bends sharply (docs/optimization.md compares both).
template <int dim>
class DeformationSpace {
 public:
  /// `fixed`: the nodes where deformations vanish.
  DeformationSpace(const Lattice<dim>& lattice, std::vector<bool> fixed, double length, DeformationKind kind,
                   Invariance invariance = Invariance::none);

  int n_components() const { return kind_ == DeformationKind::vector_field ? dim : 1; }

  /// The deformation t with (t, w) = load . w for all deformations w.
  std::vector<double> representative(std::span<const double> load) const;

  /// The load l with l . w = (deformation, w) for all deformations w.
  std::vector<double> load(std::span<const double> deformation) const;

  /// The motion of a boundary under these deformations.
  BoundaryMotion<dim> motion_of(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary) const {
    return {psi, boundary, kind_};
  }

  /// BoundaryMotion::speeds_at_nodes() of any deformation, without the fixed nodes.
  std::vector<double> speeds(const LevelSet<dim>& psi, std::span<const double> deformation) const;

 private:
  std::vector<double> restricted(std::span<const double> component) const;
  template <class Function>
  std::vector<double> by_component(std::span<const double> vector, Function function) const;

  Lattice<dim> lattice_;
  std::vector<bool> fixed_;
  DeformationKind kind_;
  Invariance invariance_;
  std::vector<SparseSpd::Entry> form_;  ///< of one component: lower triangle, without fixed nodes
  SparseSpd factor_;
};

}  // namespace wheelwright
