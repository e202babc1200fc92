#include "wheelwright/case/load_case_change.h"

namespace wheelwright {

bool is_load_of_a_case(const Load& section, const Load& load) {
  return load.lateral_force == section.lateral_force && load.camber == section.camber &&
         load.positions == section.positions;
}

CaseLoad changed_load_case(CaseLoad load_case, const Load& section, const Load& load) {
  // Values equal to the section's are not repeated.
  const auto change = [&](auto& place, const auto& of_section, const auto& value) {
    if (place || value != of_section) place = value;
  };
  load_case.travel = load.travel;
  load_case.force = load.travel ? std::nullopt : std::optional(load.force);
  change(load_case.horizontal_force, section.horizontal_force, load.horizontal_force);
  change(load_case.torque, section.torque, load.torque);
  change(load_case.body_force, section.body_force, load.body_force);
  change(load_case.hole_pressure, section.hole_pressure, load.hole_pressure);
  change(load_case.speed, section.speed, load.speed);
  return load_case;
}

}  // namespace wheelwright
