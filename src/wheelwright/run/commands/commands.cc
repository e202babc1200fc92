#include "wheelwright/run/commands/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "wheelwright/case/key_value.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/load_values.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/shown_value.h"

namespace wheelwright {
namespace {

CommandResult changed(RunControl& run, const Case& c, const std::string& what) {
  if (auto refusal = run.change_case(c, what)) return *std::move(refusal);
  return what;
}

}  // namespace

/// Those of the ground may be absent: then it is flat.
CommandFields load_fields(Load& load) {
  CommandFields fields;
  for (const Key<Load>& key : load_values(load))
    visit_value(key, load, [&](auto& value) {
      constexpr bool is_optional = requires { value.reset(); };
      if constexpr (requires { CommandField{"", "", &value}; })
        fields.push_back({json_name(key), std::string(key.meaning), &value,
                          !is_optional && key.name.starts_with("ground")});
    });
  return fields;
}

CommandFields NewLoad::fields() {
  CommandFields fields{{"load_case", "its name; absent: the case has one load", &load_case}};
  const CommandFields of_load = load_fields(load);
  fields.insert(fields.end(), of_load.begin(), of_load.end());
  return fields;
}

CommandKinds commands_of_every_run(const OwnLoadKeys& own) {
  NewLoad usual_load;
  usual_load.load.own = own.usual_values();
  return {command_kind<Save>(),     command_kind<Stop>(),      command_kind<Pause>(),
          command_kind<Continue>(), command_kind<Step>(),      command_kind<NewWeights>(),
          command_kind(usual_load), command_kind<NewVolume>(), command_kind<NewWidths>(),
          command_kind<NewBound>(), command_kind<Paint>(),     command_kind<MoveHole>(),
          command_kind<FillHole>(), command_kind<TakeShape>(), command_kind<Reset>(),
          command_kind<Undo>()};
}

CommandResult Save::execute(RunControl& run) const {
  run.save();
  return fmt::format("shape {} is saved", run.iteration());
}

CommandResult Stop::execute(RunControl& run) const {
  run.stop();
  return fmt::format("stopping after shape {}, whose results are written now", run.iteration());
}

CommandResult Pause::execute(RunControl& run) const {
  if (auto refusal = run.pause(0)) return *std::move(refusal);
  return fmt::format("paused after shape {}", run.iteration());
}

CommandResult Continue::execute(RunControl& run) const {
  if (auto refusal = run.continue_run()) return *std::move(refusal);
  return std::string("continued");
}

CommandResult Step::execute(RunControl& run) const {
  if (auto refusal = run.pause(1)) return *std::move(refusal);
  return fmt::format("one more shape after shape {}", run.iteration());
}

CommandResult NewWeights::execute(RunControl& run) const {
  Case c = run.current_case();
  std::vector<std::string> words;
  const auto set = [&](std::string_view quantity, const std::optional<double>& weight) {
    if (!weight) return;
    c.objective.*objective_weight(quantity)->weight = *weight;
    words.push_back(fmt::format("{} {:.6g}", quantity, *weight));
  };
  set("strain_energy", strain_energy);
  set("uniformity_annulus", uniformity_annulus);
  set("uniformity_dual", uniformity_dual);
  set("uniformity_l2", uniformity_l2);
  return changed(run, c, fmt::format("new weights: {}", fmt::join(words, ", ")));
}

CommandResult NewLoad::execute(RunControl& run) const {
  Case c = run.current_case();
  if (!have_same_keys(c.load, load)) return Refusal{"the load does not have the keys of the case's load"};
  if (!load_case) {
    if (!c.load.cases.empty()) return Refusal{"the case has several loads: say which load case changes"};
    c.load = load;
    c.load.cases.clear();
    return changed(run, c, "new load: " + load_text(load));
  }
  const auto found = std::ranges::find(c.load.cases, *load_case, &CaseLoad::name);
  if (found == c.load.cases.end()) return Refusal{fmt::format("there is no load case {}", *load_case)};
  if (!is_load_of_a_case(c.load, load))
    return Refusal{fmt::format("{} are the same in all load cases", fmt::join(shared_load_keys(), ", "))};
  *found = changed_load_case(*found, c.load, load);
  return changed(run, c, fmt::format("new load in {}: {}", *load_case, load_text(load)));
}

CommandResult NewWidths::execute(RunControl& run) const {
  Case c = run.current_case();
  std::vector<std::string> words;
  const auto set = [&](const char* what, const std::optional<double>& width, std::optional<double>& place) {
    if (!width) return;
    place = *width != 0 ? width : std::nullopt;
    words.push_back(*width != 0 ? fmt::format("{} {:.6g} m", what, *width) : fmt::format("any {}", what));
  };
  set("wall", minimum_wall, c.optimizer.minimum_wall);
  set("gap", minimum_gap, c.optimizer.minimum_gap);
  set("radius of corners", minimum_radius, c.optimizer.minimum_radius);
  return changed(run, c, fmt::format("new least widths: {}", fmt::join(words, ", ")));
}

CommandResult NewBound::execute(RunControl& run) const {
  Case c = run.current_case();
  if (constraint < 0 || constraint >= static_cast<int>(c.constraints.size()))
    return Refusal{"the case has no such bound"};
  Constraint& bound = c.constraints[constraint];
  std::vector<std::string> words;
  const auto set = [&](const char* what, const std::optional<double>& value, std::optional<double>& place) {
    if (!value) return;
    place = value;
    words.push_back(fmt::format("{} {}", what, shown_text(bound.quantity, *value, c.wheel)));
  };
  set("at least", at_least, bound.at_least);
  set("at most", at_most, bound.at_most);
  set("equal to", equals, bound.equals);
  return changed(
      run, c,
      fmt::format("new bound: {} {}", wheelwright::name(quantity_of(c, bound)), fmt::join(words, ", ")));
}

CommandResult TakeShape::execute(RunControl& run) const {
  const std::string what = fmt::format("the shape of {}", file);
  if (auto refusal = run.take_shape(file, what)) return *std::move(refusal);
  return what;
}

CommandResult NewVolume::execute(RunControl& run) const {
  Case c = run.current_case();
  c.volume.target = target;
  return changed(run, c, fmt::format("new target of the volume: {:.6g} of the ring", target));
}

CommandResult Reset::execute(RunControl& run) const {
  if (auto refusal = run.reset()) return *std::move(refusal);
  return std::string("back to the initial shape");
}

CommandResult Undo::execute(RunControl& run) const {
  auto undone = run.undo();
  if (!undone) return undone.failure();
  return "undid: " + *undone;
}

}  // namespace wheelwright
