#include "wheelwright/case/quantity_needs.h"

namespace wheelwright {
namespace {

bool has(const Case& c, Input input) {
  switch (input) {
    case Input::density:
      return c.material.density.has_value();
    case Input::load:
      return !c.load.travel;
    case Input::travel:
      return c.load.travel.has_value();
    case Input::horizontal_force:
      return c.load.horizontal_force != 0;
    case Input::torque:
      return c.load.torque != 0;
    case Input::several_positions:
      return c.load.positions > 1;
  }
  return true;
}

Need need(Input input) {
  switch (input) {
    case Input::density:
      return {"material.density", "the mass needs a density"};
    case Input::load:
      return {"load.travel", "the travel varies only under a load; here it is prescribed"};
    case Input::travel:
      return {"load.travel", "the force varies only at a prescribed travel; under a load it is that load"};
    case Input::horizontal_force:
      return {"load.horizontal_force", "without that force the rim does not move along the ground"};
    case Input::torque:
      return {"load.torque", "without a torque the rim does not turn"};
    case Input::several_positions:
      return {"load.positions", "it compares load positions, and there is only one"};
  }
  return {"", ""};
}

/// Without the input.
Constancy constancy_without(Input input) {
  switch (input) {
    case Input::density:
      return {"material.density", "it is 0 without a density", "set material.density"};
    case Input::load:
      return {"load.travel", "it is the prescribed travel for every wheel",
              "set a load in place of load.travel"};
    case Input::travel:
      return {"load.force", "it is the load for every wheel", "set load.travel in place of a load"};
    case Input::horizontal_force:
      return {"load.horizontal_force", "it is 0 without that force", "set load.horizontal_force"};
    case Input::torque:
      return {"load.torque", "it is 0 without a torque", "set load.torque"};
    case Input::several_positions:
      return {"load.positions", "with one load position it is 0 for every wheel",
              "use load.positions = 2 or more"};
  }
  return {"", "", ""};
}

}  // namespace

std::vector<Need> unmet_needs(const Case& c, const Quantity& quantity) {
  std::vector<Need> needs;
  const FunctionalFactory& functional = quantity->functional;
  if (functional && !(c.wheel.dimension == 2 ? functional.in<2>() != nullptr : functional.in<3>() != nullptr))
    needs.push_back({"wheel.dimension", "it is computed only in the other dimension"});
  for (const Input input : quantity->needs)
    if (!has(c, input)) needs.push_back(need(input));
  return needs;
}

std::optional<Constancy> constancy(const Case& c, const Quantity& quantity) {
  for (const Input input : quantity->varies_with)
    if (!has(c, input)) return constancy_without(input);
  return {};
}

}  // namespace wheelwright
