#pragma once

#include <memory>
#include <optional>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/islands.h"
#include "wheelwright/evolution/smoothing.h"
#include "wheelwright/evolution/velocity.h"
#include "wheelwright/evolution/volume.h"

namespace wheelwright {

struct EvolutionOptions {
  VelocityOptions velocity;
  double smoothing = 0;   ///< tau of (76), in squares of the grid's resolution; 0: smooth() does nothing
  double rim_band = 0;    ///< [m]
  double tread_band = 0;  ///< [m]
};

/// Everything that moves shapes of one lattice; factors what depends on the lattice alone once. All shapes it
/// returns keep the protected bands; what it moved has no structure below the cells (cell_scale.h), and is
/// its own mirror image if the shape and its velocity were (geometry/mirror.h). A NaN or an infinity that
/// comes in, or out of a stage, is the failure not_finite.
template <int dim>
class Evolver {
 public:
  Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options);

  /// Descent velocity of the shape gradient density G, and the same made to preserve the measure. Where the
  /// boundary lies on the edge of a band and would go into it, G is left out.
  Expected<std::vector<double>> velocity(std::span<const SurfaceSample<dim>> gradient) const;
  Expected<std::vector<double>> measure_preserving_velocity(
      std::span<const SurfaceSample<dim>> gradient) const;

  /// Transport for as long as the fastest node takes to travel `distance` [m]. `velocity` is not all zero.
  Expected<LevelSet<dim>> move(const LevelSet<dim>& psi, std::span<const double> velocity,
                               double distance) const;

  /// By how much that motion changes the objective that has this gradient, to first order.
  double first_order_change(std::span<const SurfaceSample<dim>> gradient, std::span<const double> velocity,
                            double distance) const;

  Expected<LevelSet<dim>> redistance(const LevelSet<dim>& psi) const;
  Expected<LevelSet<dim>> smooth(const LevelSet<dim>& psi) const;
  LevelSet<dim> keep_bands(const LevelSet<dim>& psi) const;

  /// As the free functions of these names.
  Expected<MeasuredShape<dim>> with_measure(const LevelSet<dim>& psi, double target,
                                            double boundary_measure) const;
  Expected<AttachedShape<dim>> without_islands(const LevelSet<dim>& psi, double largest) const;

  /// What happened to the holes between two shapes: topology_changes(), and those that came to a band.
  std::vector<ShapeEvent<dim>> changes(const LevelSet<dim>& before, const LevelSet<dim>& after) const;

 private:
  template <class Extend>
  Expected<std::vector<double>> movable_velocity(std::span<const SurfaceSample<dim>> gradient,
                                                 Extend extend) const;

  Expected<LevelSet<dim>> kept(const LevelSet<dim>& psi, bool is_symmetric, const char* what) const;

  Lattice<dim> lattice_;
  ProtectedBands<dim> bands_;
  std::unique_ptr<VelocityExtension<dim>> extension_;
  std::optional<Smoother<dim>> smoother_;
};

}  // namespace wheelwright
