#pragma once

#include <memory>
#include <optional>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/evolution/deformation_space.h"
#include "wheelwright/shape/evolution/feature_size.h"
#include "wheelwright/shape/evolution/islands.h"
#include "wheelwright/shape/evolution/smoothing.h"
#include "wheelwright/shape/evolution/velocity.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/evolution/widths.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {

/// The space of level sets of degree 2 in which shapes move.
enum class ShapeSpace {
  nodal,   ///< all nodal values, filtered below the cell (sub_cell_filter.h): what steepest descent moves
  spline,  ///< cubic B-splines (spline_level_set.h), whose motion BoundaryMotion predicts
};

struct EvolutionOptions {
  VelocityOptions velocity;
  /// tau of (76), in units of the squared resolution of the grid. With 0, smooth() is the identity.
  double smoothing = 0;
  Bands bands;                ///< that stay material
  FeatureSize features = {};  ///< the minimum widths of walls and gaps in every shape
  ShapeSpace space = ShapeSpace::nodal;
  Invariance invariance = Invariance::none;                     ///< of all shapes and their motions
  DeformationKind deformation = DeformationKind::vector_field;  ///< in the space of deformations()
  int cut_points = 4;  ///< Gauss points per direction in cut cells; as in a solver that reuses them
};

/// Moves shapes on one lattice. Matrices that depend only on the lattice are factored once. All returned
/// shapes keep the protected bands and the invariance of the options, which the given shapes must have.
/// move(), redistance() and smooth() act on the design of a shape, its nodal values or the coefficients of
/// its spline; the shapes that they return are of the ShapeSpace, and mirror-symmetric if the given shape and
/// velocity are (shape/geometry/mirror.h). A NaN or infinity in the input or in the result of a stage is the
/// failure not_finite.
template <int dim>
class Evolver {
 public:
  Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options);

  /// Descent velocity of the density G of the shape gradient, and the descent velocity that also
  /// preserves the measure. G is ignored where the boundary lies on the edge of a band and would move into
  /// it.
  Expected<std::vector<double>> velocity(std::span<const SurfaceSample<dim>> gradient) const;
  Expected<std::vector<double>> measure_preserving_velocity(
      std::span<const SurfaceSample<dim>> gradient) const;

  /// The deformations that vanish in the bands, with the inner product of velocity.length.
  const DeformationSpace<dim>& deformations() const { return deformations_; }

  /// For each boundary point, whether it lies on the edge of a band.
  std::vector<bool> at_bands(std::span<const SurfacePoint<dim>> boundary) const;

  /// Adds to `held` the nodes whose coefficients a band would stop under this velocity: those at the edge of
  /// a band that would move into it by more than allowed. One flag per node. Returns whether it added any.
  bool hold_at_bands(const LevelSet<dim>& coefficients, std::span<const double> velocity, double distance,
                     std::vector<bool>& held) const;

  /// Adds to `following` what the way in which the wheel is made lets follow other values under this velocity
  /// of the coefficients (MadeShapes::follow()). Returns whether it added any.
  bool follow_as_made(const LevelSet<dim>& coefficients, std::span<const double> velocity, double distance,
                      Following& following) const;

  /// Transports the shape for the time in which the fastest node travels `distance` [m]. Fails if `velocity`
  /// vanishes everywhere.
  Expected<LevelSet<dim>> move(const LevelSet<dim>& psi, std::span<const double> velocity,
                               double distance) const;

  /// First-order change of the objective with this gradient under the same motion.
  double first_order_change(std::span<const SurfaceSample<dim>> gradient, std::span<const double> velocity,
                            double distance) const;

  /// The shape whose design is about a signed distance, with the same boundary.
  Expected<LevelSet<dim>> redistance(const LevelSet<dim>& psi) const;

  /// The signed distance to the boundary of a drawn level set that never moved: not a spline, so that the
  /// boundary stays unchanged.
  Expected<LevelSet<dim>> distance(const LevelSet<dim>& psi) const;

  Expected<LevelSet<dim>> smooth(const LevelSet<dim>& psi) const;
  LevelSet<dim> keep_bands(const LevelSet<dim>& psi) const;

  /// The shape of the ShapeSpace that a move by nothing makes of this one: what a shape that was not moved
  /// but made otherwise must become, or the next move changes it, however short. Keeps the bands.
  LevelSet<dim> in_space(const LevelSet<dim>& psi) const;

  /// The minimum widths of walls and gaps in every shape.
  const FeatureSize& features() const { return features_; }

  /// The shape with these minimum widths: balls are added to thinner walls, and narrower gaps are filled
  /// (with_feature_size()).
  LevelSet<dim> with_features(const LevelSet<dim>& psi, const FeatureSize& size) const;

  /// Like the free functions of the same names, but with the given widths enforced, or features() by default:
  /// missing widths are restored by the smallest deformation of the boundary (widening()), after
  /// with_features() if much of one is missing. Fail with too_narrow if a width is still missed by more than
  /// a thousandth. A shape that misses none by more is not changed, so that an accepted shape stays the same
  /// to the last digit.
  Expected<MeasuredShape<dim>> measured(LevelSet<dim> psi, const FeatureSize& size) const;
  Expected<MeasuredShape<dim>> with_measure(const LevelSet<dim>& psi, double target, double boundary_measure,
                                            const FeatureSize& size) const;
  Expected<MeasuredShape<dim>> with_measure(const LevelSet<dim>& psi, double target,
                                            double boundary_measure) const {
    return with_measure(psi, target, boundary_measure, features_);
  }

  Expected<AttachedShape<dim>> without_islands(const LevelSet<dim>& psi, double largest) const;

  /// Changes of the holes between two shapes: topology_changes(), and holes that reached a protected band.
  std::vector<ShapeEvent<dim>> changes(const LevelSet<dim>& before, const LevelSet<dim>& after) const;

 private:
  template <class Extend>
  Expected<std::vector<double>> movable_velocity(std::span<const SurfaceSample<dim>> gradient,
                                                 Extend extend) const;

  template <class Measure>
  Expected<MeasuredShape<dim>> with_widths(LevelSet<dim> psi, const FeatureSize& size, bool keeps_measure,
                                           Measure measure) const;
  Expected<LevelSet<dim>> widened(const LevelSet<dim>& psi, const std::vector<Width<dim>>& widths,
                                  bool keeps_measure) const;

  /// The shapes that with_measure() chooses from. They refer to psi.
  ShapeOfShift<dim> shifted(const LevelSet<dim>& psi) const;

  /// The stages act on the design of a shape. shape_of() returns the shape of a design, with the bands kept.
  LevelSet<dim> design_of(const LevelSet<dim>& psi) const;
  LevelSet<dim> shape_of(LevelSet<dim> design) const;

  /// The shape with the symmetries that others must have like this one.
  LevelSet<dim> like(const LevelSet<dim>& other, LevelSet<dim> psi) const;

  /// The shape of a design, with these symmetries.
  LevelSet<dim> shape_with(const std::vector<MirrorPlane>& symmetries, LevelSet<dim> design) const;

  /// The shape of the design that is the result of a stage, symmetrized.
  Expected<LevelSet<dim>> finished(LevelSet<dim> design, const std::vector<MirrorPlane>& symmetries,
                                   const char* what) const;

  Lattice<dim> lattice_;
  ShapeSpace space_;
  Invariance invariance_;
  ProtectedBands<dim> bands_;
  std::unique_ptr<VelocityExtension<dim>> extension_;
  DeformationSpace<dim> deformations_;
  std::optional<Smoother<dim>> smoother_;
  FeatureSize features_;
  int cut_points_;
};

}  // namespace wheelwright
