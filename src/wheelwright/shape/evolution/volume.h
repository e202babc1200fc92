#pragma once

#include <functional>
#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/evolution/protected_bands.h"

namespace wheelwright {

/// How well with_measure() reaches its target, relative.
inline constexpr double measure_tolerance = 1e-6;

/// A shape, its cells, and the measure of its material in one sector [m^2, or m^3 when dim = 3].
template <int dim>
struct MeasuredShape {
  LevelSet<dim> shape;
  CutDomain<dim> domain;
  double measure;
};

/// Measures a shape with `points` Gauss points per direction in cut cells. Fails as cut_domain() does.
template <int dim>
Expected<MeasuredShape<dim>> measured(LevelSet<dim> psi, int points);

/// psi + shift [m]. Nodes in the bands keep their values.
template <int dim>
LevelSet<dim> shifted(LevelSet<dim> psi, const ProtectedBands<dim>& bands, double shift);

/// The shape for a shift of its level set [m]: one with less material the larger the shift.
template <int dim>
using ShapeOfShift = std::function<LevelSet<dim>(double shift)>;

/// The shape for the shift with which the material of one sector has the area `target` [m^2], or the volume
/// [m^3] when dim = 3, up to a relative error of measure_tolerance. `boundary_measure` is an estimate of the
/// length (or area) of {psi = 0} in one sector; it is the initial slope of the secant method, which starts
/// with the shift 0. `points`: as for measured(). Fails with empty_shape if no shift within the thickness of
/// the ring gives this measure, with cut_quadrature if the measure jumps across the target or cannot be
/// computed, and with not_finite.
template <int dim>
Expected<MeasuredShape<dim>> with_measure(const ShapeOfShift<dim>& shape_of, double target,
                                          double boundary_measure, int points);

/// The multiplier lambda_k = 8 (max G - min G) (r_0 - r_k) of the paper, where r is the volume ratio (section
/// 4). The shape is then moved with the gradient G - lambda_k. This is a proportional control, so that an
/// offset of the volume remains.
template <int dim>
double proportional_multiplier(std::span<const SurfaceSample<dim>> gradient, double target_ratio,
                               double ratio);

}  // namespace wheelwright
