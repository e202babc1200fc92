#pragma once

#include <span>

#include "wheelwright/mechanics/heat/temperature_field.h"
#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The densities of the derivative of Conduction's a(theta, v) with respect to the shape, with the nodal
/// values of both fields held, at points of the moving boundary of psi:
///   k grad theta . grad v + s theta v + h (d_n (theta v) + kappa theta v),
/// with the sink s of the side faces when dim = 2, h of the holes, and the kinks of the boundary
/// (kink_densities()). The ghost penalty does not depend on the shape. `domain`: the cells of psi.
template <int dim>
std::vector<double> conduction_densities(const RollingModel<dim>& model, const LevelSet<dim>& psi,
                                         const CutDomain<dim>& domain,
                                         std::span<const SurfacePoint<dim>> points,
                                         const TemperatureField<dim>& theta, const TemperatureField<dim>& v);

/// Those at points of the edges in which the moving boundary meets the side faces, of the normal e: h_s theta
/// v / sqrt(1 - (n.e)^2) with h_s of the side faces.
std::vector<double> conduction_edge_densities(const RollingModel<3>& model,
                                              std::span<const SurfacePoint<3>> points,
                                              const TemperatureField<3>& theta, const TemperatureField<3>& v);

}  // namespace wheelwright
