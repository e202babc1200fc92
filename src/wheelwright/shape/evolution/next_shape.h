#pragma once

#include <optional>
#include <span>
#include <vector>

#include "wheelwright/shape/evolution/evolver.h"

namespace wheelwright {

/// How a shape moves, and what is done to its level set afterwards.
struct ShapeMotion {
  std::span<const double> velocity;  ///< along the outward normal of the material, at the nodes
  double distance;                   ///< travelled by the fastest node [m]
  bool redistances = false;          ///< Evolver::redistance()
  bool smooths = false;              ///< Evolver::smooth()
};

/// What a finished shape must satisfy.
struct ShapeRequirements {
  std::optional<double> measure;  ///< of the material in one sector [m^2, or m^3 when dim = 3]; absent: any
  double boundary_measure;        ///< estimate of the length (area) of its boundary, for with_measure()
  FeatureSize widths;             ///< minimum widths of walls, gaps and corners
  double largest_island;          ///< smaller islands are removed, larger ones are a failure [m^2 or m^3]
};

/// A shape that satisfies its requirements, with its cells.
template <int dim>
struct NextShape {
  LevelSet<dim> shape;
  CutDomain<dim> domain;
  double measure;                        ///< of the material in one sector [m^2, or m^3 when dim = 3]
  std::vector<ShapeEvent<dim>> removed;  ///< islands
};

/// A shape whose next stage failed.
template <int dim>
struct UnfinishedShape {
  LevelSet<dim> shape;                   ///< of the last stage that succeeded
  double measure;                        ///< the last one that was reached; NaN: none
  std::vector<ShapeEvent<dim>> removed;  ///< islands
  Failure failure;                       ///< of the next stage
};

template <int dim>
using ShapeResult = Expected<NextShape<dim>, UnfinishedShape<dim>>;

/// From one shape to the next: transport, redistancing, smoothing, then finished_shape(). Fails as these
/// functions do.
template <int dim>
ShapeResult<dim> next_shape(const Evolver<dim>& evolver, const LevelSet<dim>& psi, const ShapeMotion& motion,
                            const ShapeRequirements& required);

/// The same for a shape that has moved already. Fails as these functions do.
template <int dim>
ShapeResult<dim> reshaped(const Evolver<dim>& evolver, const LevelSet<dim>& moved, bool redistances,
                          bool smooths, const ShapeRequirements& required);

/// The shape as it is, with these minimum widths. Fails like Evolver::measured().
template <int dim>
ShapeResult<dim> measured_shape(const Evolver<dim>& evolver, const LevelSet<dim>& psi,
                                const FeatureSize& widths);

/// The shape with the required measure and widths, and without islands. The shift to the measure makes up for
/// removed islands and can create new ones, so both are repeated. Fails like Evolver::with_measure(),
/// measured() and without_islands(), and with disconnected_material if islands keep reappearing.
template <int dim>
ShapeResult<dim> finished_shape(const Evolver<dim>& evolver, LevelSet<dim> psi,
                                const ShapeRequirements& required);

}  // namespace wheelwright
