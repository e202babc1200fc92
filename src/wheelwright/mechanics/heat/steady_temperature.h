#pragma once

#include "wheelwright/mechanics/heat/conduction.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// Whether a model says how warm the wheel gets while it rolls: it has a speed, a cooling, and the loss
/// factors and conductivities of all materials.
template <int dim>
bool has_temperatures(const RollingModel<dim>& model);

/// The steady temperature of a rolling wheel.
template <int dim>
struct SteadyTemperature {
  ConductionSolver<dim> solver;
  std::vector<double> heat;    ///< heat_loads()
  TemperatureField<dim> rise;  ///< over the ambient temperature [K]
};

/// From the states of a shape at all positions of the sector; the model must have temperatures. Fails as
/// ConductionSolver does.
template <int dim>
Expected<SteadyTemperature<dim>> steady_temperature(const StateSolver<dim>& solver, const State<dim>& state);

/// The temperature of the rim [deg C], if it is given and higher than that of all points of the material
/// beside it, of which the warmest one has the temperature `warmest`: then the rim is the warmest place of
/// that material.
std::optional<double> warmest_rim(const Cooling& cooling, double warmest);

/// What leaves a sector through its surfaces, in the order of CooledSurface, and through the rim [W, per
/// metre of width when dim = 2]. Together they are the sum of the heat.
struct HeatFlows {
  std::array<double, n_cooled_surfaces> surfaces;
  double rim;
};
template <int dim>
HeatFlows heat_flows(const Conduction<dim>& conduction, const std::vector<double>& heat,
                     const std::vector<double>& rise);

}  // namespace wheelwright
