#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

void heat_conflicts(const Case& c, Conflicts& found) {
  if (c.heat == Heat()) return;
  const std::string of_layers = c.layers.empty() ? "" : ", and that of each [[material.layer]]";
  const auto add = [&](CaseKeys keys, std::string problem, std::string remedy) {
    found.push_back({std::move(keys), std::move(problem), std::move(remedy)});
  };
  // The section, and its keys, one of which is given.
  const auto of_section = [](const CaseKey& key) {
    CaseKeys keys{CaseKey{std::string(heat_section().name)}, key};
    for (const auto& of_heat : heat_section().keys)
      keys.push_back({std::string(heat_section().name), {of_heat.name}});
    return keys;
  };
  const auto cooled = cooling(c);
  const bool only_in_holes =
      cooled && !cooled->rim_temperature && cooled->tread == 0 && cooled->side_faces == 0;
  if (!cooled || (only_in_holes && !has_holes(c)))
    add(of_section(key_of(&Heat::convection)), "nothing takes the heat of the wheel",
        "set heat.convection or heat.rim_temperature");
  if (!has_loss_factor(c))
    add(of_section(key_of(&Material::loss_factor)), "the heat comes from the loss factors of all materials",
        "set material.loss_factor" + of_layers + "; 0 for one without losses");
  if (!has_conductivity(c))
    add(of_section(key_of(&Material::conductivity)),
        "how warm the wheel gets needs the conductivity of every material",
        "set material.conductivity" + of_layers);
  const auto loads = single_loads(c);
  if (std::ranges::all_of(loads, [](const SingleLoad& single) { return single.c.load.speed == 0; }))
    add(of_section(loads.front().key(&Load::speed)), "how warm the wheel gets depends on its speed",
        "set load.speed");
  if (c.wheel.dimension == 3 && c.wheel.side_faces == SideFaces::symmetric &&
      c.heat.side_convection.value_or(0) > 0)
    add({key_of(&Heat::side_convection), key_of(&Wheel::side_faces)},
        "a slice of a wider wheel has no side faces that the air cools",
        "omit side_convection, or use side_faces = \"free\"");
}

}  // namespace wheelwright
