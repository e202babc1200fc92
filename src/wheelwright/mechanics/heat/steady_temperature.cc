#include "wheelwright/mechanics/heat/steady_temperature.h"

#include <numeric>

#include "wheelwright/mechanics/heat/heat_source.h"

namespace wheelwright {

template <int dim>
bool has_temperatures(const RollingModel<dim>& model) {
  return model.cooling && model.cooling->any() && rolling_speed(model) > 0 &&
         has_loss_factors(model.materials) && has_conductivities(model.materials);
}

template <int dim>
Expected<SteadyTemperature<dim>> steady_temperature(const StateSolver<dim>& solver, const State<dim>& state) {
  auto conduction = ConductionSolver<dim>::create(Conduction<dim>(state.model(), state.domain()));
  if (!conduction) return conduction.failure();
  std::vector<double> heat = heat_loads(solver, state);
  auto rise = conduction->solve(heat, std::vector<double>(heat.size(), state.model().cooling->rim_rise()));
  if (!rise) return rise.failure();
  return SteadyTemperature<dim>{*std::move(conduction), std::move(heat), *std::move(rise)};
}

std::optional<double> warmest_rim(const Cooling& cooling, double warmest) {
  return cooling.rim_temperature && *cooling.rim_temperature > warmest ? cooling.rim_temperature
                                                                       : std::nullopt;
}

template <int dim>
HeatFlows heat_flows(const Conduction<dim>& conduction, const std::vector<double>& heat,
                     const std::vector<double>& rise) {
  HeatFlows flows{};
  for (int surface = 0; surface < n_cooled_surfaces; ++surface) {
    const auto& exchange = conduction.exchange(static_cast<CooledSurface>(surface));
    flows.surfaces[surface] = std::inner_product(exchange.begin(), exchange.end(), rise.begin(), 0.0);
  }
  if (!conduction.has_given_rim()) return flows;
  const std::vector<double> taken = conduction.times(rise);
  for (std::size_t node = 0; node < rise.size(); ++node)
    if (conduction.is_at_rim(static_cast<int>(node))) flows.rim += heat[node] - taken[node];
  return flows;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                  \
  template decltype(has_temperatures<dim>) has_temperatures<dim>;     \
  template decltype(steady_temperature<dim>) steady_temperature<dim>; \
  template decltype(heat_flows<dim>) heat_flows<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
