#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/shape/evolution/cubic_interpolant.h"
#include "wheelwright/shape/evolution/followers.h"
#include "wheelwright/shape/evolution/spline_level_set.h"

namespace wheelwright {

/// The kinds of deformations. They move the boundary along the outward normal n of the material.
enum class DeformationKind {
  vector_field,  ///< theta, in polar directions (radial, azimuthal[, axial]); moves the boundary by theta . n
  normal_speed,  ///< v; moves the boundary by v
};

/// How fast the boundary {psi = 0} of one shape moves along its normal under a deformation, to first order
/// and exactly as Evolver::move() moves it. The deformation changes the coefficients c of psi's spline
/// (spline_level_set.h) at the vertices at the rate -theta . grad c, or -v |grad c|; psi follows, and the
/// boundary moves by -(d psi / dt) / |grad psi|. Where c is a signed distance and the deformation smooth,
/// this is theta . n, or v. Midway between two boundaries about a cell apart, where c has a kink, it is not.
template <int dim>
class BoundaryMotion {
 public:
  BoundaryMotion(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary, DeformationKind kind);

  /// The motion with the coefficients at these nodes held fixed. One flag per node.
  BoundaryMotion holding(const std::vector<bool>& held) const;

  /// The motion of these points of the boundary of the same shape if some values follow others
  /// (MadeShapes::follow()).
  BoundaryMotion following(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> points,
                           Following following) const;

  /// The same motion at other points of the boundary of the same shape.
  BoundaryMotion on(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> points) const;

  /// The coefficients that move.
  const LevelSet<dim>& coefficients() const { return coefficients_; }

  /// Speeds of the coefficients along their normals at the nodes, for Evolver::move(). Vector fields do not
  /// move coefficients whose gradient vanishes there.
  std::vector<double> speeds_at_nodes(std::span<const double> deformation) const;

  /// Speeds along the normal, one per point of the boundary. `deformation` has one component after the other,
  /// each at all nodes of the lattice.
  std::vector<double> speeds(std::span<const double> deformation) const;

  /// The load l with l . deformation = the sum over the points of weight * density * speed, for every
  /// deformation. `density` has one value per point.
  std::vector<double> load(std::span<const double> density) const;

  /// The load l with l . deformation = the rate of a function of the coefficients, for every deformation.
  /// `dependences`: how the function depends on the coefficients.
  std::vector<double> load(std::span<const Dependence> function) const;

 private:
  /// A point of the boundary.
  struct Place {
    std::size_t first, last;  ///< of its dependences
    double steepness;         ///< |grad psi|
    double measure;           ///< the weight of the point in integrals
  };
  struct Boundary {
    std::vector<Place> places;
    std::vector<Dependence> dependences;
  };
  static Boundary boundary_of(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> points,
                              const Followers& following);

  LevelSet<dim> coefficients_;
  DeformationKind kind_;
  std::vector<Vec<dim>> gradients_;  ///< of the coefficients, in polar directions
  std::vector<bool> held_;
  std::vector<Vec<dim>> rates_;  ///< -dc/dt at the nodes per unit of each component of the deformation
  std::shared_ptr<const Following> following_;
  std::shared_ptr<const Boundary> boundary_;

  std::vector<double> load_at_nodes(std::vector<double> value) const;
  std::vector<double> rates_at_nodes(std::span<const double> deformation) const;
  int n_components() const { return kind_ == DeformationKind::vector_field ? dim : 1; }
};

/// The motion of a point of the zero set of a level set's interpolant along the outward normal, as a function
/// of the coefficients of its spline. The point is in units of the node spacing of the lattice.
template <int dim>
std::vector<Dependence> displacement(const CubicInterpolant<dim>& psi, const Vec<dim>& point);

/// The gradient of a level set at all nodes by central differences, one-sided at the ends of the lattice, in
/// polar directions.
template <int dim>
std::vector<Vec<dim>> gradients_at_nodes(const LevelSet<dim>& psi);

}  // namespace wheelwright
