#pragma once

#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/evolution/protected_bands.h"

namespace wheelwright {

/// A shape and the measure of its material in one sector [m^2, or m^3 when dim = 3].
template <int dim>
struct MeasuredShape {
  LevelSet<dim> shape;
  double measure;
};

/// The shape psi + c, with the one constant c that gives the material the measure `target` to 1e-6 relative
/// [m^2 a sector, or m^3]. Nodes in the bands keep their value. `boundary_measure` is a guess of the length
/// (area) of {psi = 0} in one sector, the slope of the measure. Fails with empty_shape where no c within the
/// ring's thickness gives that measure, with cut_quadrature where the measure jumps across the target or
/// cannot be found, with not_finite where psi is not finite.
template <int dim>
Expected<MeasuredShape<dim>> with_measure(const LevelSet<dim>& psi, const ProtectedBands<dim>& bands,
                                          double target, double boundary_measure);

/// Measure of the whole sector, holes included.
template <int dim>
double sector_measure(const PolarGrid<dim>& grid);

/// The paper's multiplier lambda_k = 8 (max G - min G) (r_0 - r_k), with r the volume ratios (section 4); the
/// material is then moved with G - lambda_k. Proportional only: an offset of the volume remains.
template <int dim>
double proportional_multiplier(std::span<const SurfaceSample<dim>> gradient, double target_ratio,
                               double ratio);

}  // namespace wheelwright
