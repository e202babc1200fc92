#include "wheelwright/case/quantity_needs.h"

#include <fmt/format.h>

#include <algorithm>

namespace wheelwright {

std::vector<Need> unmet_needs(const Case& c, Quantity quantity) {
  std::vector<Need> needs{
      {{Quantity::mass}, "material.density", c.material.density.has_value(), "the mass needs a density"},
      {{Quantity::force_variation, Quantity::force_variation_harmonic},
       "load.travel",
       c.load.travel.has_value(),
       "the force varies only at a prescribed travel; under a load it is that load"},
      {{Quantity::run_out, Quantity::run_out_harmonic},
       "load.travel",
       !c.load.travel,
       "the travel varies only under a load; here it is prescribed"},
      {{Quantity::tangential_stiffness},
       "load.horizontal_force",
       c.load.horizontal_force != 0,
       "without that force the rim does not move along the ground"},
      {{Quantity::torsional_stiffness},
       "load.torque",
       c.load.torque != 0,
       "without a torque the rim does not turn"}};
  std::erase_if(needs, [&](const Need& need) {
    return need.is_given || std::ranges::find(need.quantities, quantity) == need.quantities.end();
  });
  return needs;
}

std::optional<Constancy> constancy(const Case& c, Quantity quantity) {
  const auto is_one_of = [quantity](std::initializer_list<Quantity> list) {
    return std::ranges::find(list, quantity) != list.end();
  };
  if (c.load.positions == 1 && is_one_of({Quantity::run_out, Quantity::run_out_harmonic,
                                          Quantity::force_variation, Quantity::force_variation_harmonic}))
    return Constancy{"load.positions", "with one load position it is 0 for every wheel",
                     "use load.positions = 2 or more"};
  if (c.load.travel && is_one_of({Quantity::travel, Quantity::mean_travel}))
    return Constancy{"load.travel", "it is the prescribed travel for every wheel",
                     "set a load in place of load.travel"};
  if (!c.load.travel && quantity == Quantity::radial_force)
    return Constancy{"load.force", "it is the load for every wheel", "set load.travel in place of a load"};
  return {};
}

std::string_view without_derivative(Quantity quantity) {
  switch (quantity) {
    case Quantity::objective:
      return "bound one of its terms, or another quantity";
    case Quantity::pressure_spread:
      return "use uniformity_dual, run_out or peak_pressure";
    case Quantity::minimum_wall:
      return "set optimizer.minimum_wall, which every shape keeps";
    case Quantity::minimum_gap:
      return "set optimizer.minimum_gap, which every shape keeps";
    default:
      return "";
  }
}

}  // namespace wheelwright
