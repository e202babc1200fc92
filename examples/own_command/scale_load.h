#pragma once

#include <wheelwright/run/commands/command.h>

/// Multiplies the force on the wheel by a factor. Refused if the case has several loads, or gives the travel
/// of the rim in place of a force.
struct ScaleLoad {
  static constexpr const char *name = "scale_load", *meaning = "multiplies the force by a factor";
  double factor = 1;

  wheelwright::CommandFields fields() { return {{"factor", "above 0", &factor}}; }

  wheelwright::CommandResult execute(wheelwright::RunControl& run) const {
    wheelwright::Case changed = run.current_case();
    if (!(factor > 0)) return wheelwright::Refusal{"the factor must be above 0"};
    if (!changed.load.cases.empty()) return wheelwright::Refusal{"the case has several loads"};
    if (changed.load.travel) return wheelwright::Refusal{"the case gives the travel of the rim, no force"};
    changed.load.force *= factor;
    const std::string what = "the force times " + std::to_string(factor);
    if (auto refusal = run.change_case(changed, what)) return *refusal;
    return what;
  }
};
