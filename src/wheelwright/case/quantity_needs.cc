#include "wheelwright/case/quantity_needs.h"

#include "wheelwright/case/layers.h"

namespace wheelwright {
namespace {

bool has(const Case& c, Input input, const std::optional<PartOfRing>& part) {
  switch (input) {
    case Input::density:
      return has_density(c, part);
    case Input::loss_factor:
      return has_loss_factor(c, part);
    case Input::fatigue_limit:
      return has_fatigue_limit(c, part);
    case Input::all_loss_factors:
      return has_loss_factor(c);
    case Input::conductivity:
      return has_conductivity(c);
    case Input::cooling:
      return cooling(c).has_value();
    case Input::speed:
      return c.load.speed > 0;
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

/// The need for a constant of the materials or of the cooling; nothing if the input is another one.
std::optional<Need> need_of_materials(Input input) {
  switch (input) {
    case Input::density:
      return Need{key_of(&Material::density), "the mass needs the density of every material"};
    case Input::loss_factor:
      return Need{key_of(&Material::loss_factor),
                  "the rolling resistance needs the loss factor of every material, 0 for one without losses"};
    case Input::fatigue_limit:
      return Need{key_of(&RingMaterial::fatigue_measure),
                  "fatigue needs the measure and the limit of every material"};
    case Input::all_loss_factors:
      return Need{key_of(&Material::loss_factor),
                  "the temperature needs the loss factor of every material, 0 for one without losses"};
    case Input::conductivity:
      return Need{key_of(&Material::conductivity),
                  "the temperature needs the conductivity of every material"};
    case Input::cooling:
      return Need{key_of(&Heat::convection),
                  "the temperature needs a convection or a heat.rim_temperature that takes the heat"};
    default:
      return {};
  }
}

Need need(const SingleLoad& single, Input input) {
  if (const auto of_materials = need_of_materials(input)) return *of_materials;
  switch (input) {
    case Input::speed:
      return {single.key(&Load::speed), "how warm the wheel gets needs its speed, more than 0"};
    case Input::load:
      return {single.key(&Load::travel), "the travel varies only under a load; here it is prescribed"};
    case Input::travel:
      return {single.key(&Load::travel),
              "the force varies only at a prescribed travel; under a load it is that load"};
    case Input::horizontal_force:
      return {single.key(&Load::horizontal_force),
              "without that force the rim does not move along the ground"};
    case Input::torque:
      return {single.key(&Load::torque), "without a torque the rim does not turn"};
    case Input::several_positions:
      return {single.key(&Load::positions), "it compares load positions, and there is only one"};
    default:
      return {{}, ""};
  }
}

/// Without the input.
Constancy constancy_without(const SingleLoad& single, Input input) {
  switch (input) {
    case Input::density:
      return {key_of(&Material::density), "it is 0 without a density", "set material.density"};
    case Input::loss_factor:
      return {key_of(&Material::loss_factor), "it is 0 without a loss factor", "set material.loss_factor"};
    case Input::fatigue_limit:
      return {key_of(&RingMaterial::fatigue_measure), "it is 0 without a fatigue limit",
              "set material.fatigue_measure and its limit"};
    case Input::all_loss_factors:
      return {key_of(&Material::loss_factor), "without loss factors nothing warms the wheel",
              "set material.loss_factor"};
    case Input::conductivity:
      return {key_of(&Material::conductivity), "it is not known without a conductivity",
              "set material.conductivity"};
    case Input::cooling:
      return {key_of(&Heat::convection), "it is not known without cooling", "set heat.convection"};
    case Input::speed:
      return {single.key(&Load::speed), "a wheel at rest stays cold", "set load.speed"};
    case Input::load:
      return {single.key(&Load::travel), "it is the prescribed travel for every wheel",
              "set a load in place of load.travel"};
    case Input::travel:
      return {single.key(&Load::force), "it is the load for every wheel",
              "set load.travel in place of a load"};
    case Input::horizontal_force:
      return {single.key(&Load::horizontal_force), "it is 0 without that force", "set load.horizontal_force"};
    case Input::torque:
      return {single.key(&Load::torque), "it is 0 without a torque", "set load.torque"};
    case Input::several_positions:
      return {single.key(&Load::positions), "with one load position it is 0 for every wheel",
              "use load.positions = 2 or more"};
  }
  return {{}, "", ""};
}

}  // namespace

std::vector<Need> unmet_needs(const SingleLoad& single, const Quantity& quantity) {
  std::vector<Need> needs;
  const FunctionalFactory& functional = quantity->functional;
  if (functional &&
      !(single.c.wheel.dimension == 2 ? functional.in<2>() != nullptr : functional.in<3>() != nullptr))
    needs.push_back({key_of(&Wheel::dimension), "it is computed only in the other dimension"});
  for (const Input input : quantity->needs)
    if (!has(single.c, input, quantity->part)) needs.push_back(need(single, input));
  return needs;
}

std::vector<Need> unmet_needs_of_materials(const Case& c, const Quantity& quantity) {
  std::vector<Need> needs;
  for (const Input input : quantity->needs)
    if (const auto need = need_of_materials(input); need && !has(c, input, quantity->part))
      needs.push_back(*need);
  return needs;
}

std::optional<Constancy> constancy(const SingleLoad& single, const Quantity& quantity) {
  for (const Input input : quantity->varies_with)
    if (!has(single.c, input, quantity->part)) return constancy_without(single, input);
  return {};
}

}  // namespace wheelwright
