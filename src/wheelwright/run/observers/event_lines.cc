#include "wheelwright/run/observers/event_lines.h"

#include <nlohmann/json.hpp>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/unlimited.h"
#include "wheelwright/run/checkpoints/provenance.h"
#include "wheelwright/run/observers/run_warnings.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/feature_warnings.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes of names that are not UTF-8 are replaced.
std::string line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json message(const std::string& text) { return {{"event", "message"}, {"text", text}}; }

Json warning(const std::string& subject, const std::string& text) {
  return {{"event", "warning"}, {"subject", subject}, {"text", text}};
}

template <int dim>
Json begin(const RunStarted& started, const RunView<dim>& run) {
  const Case& c = run.study.source;
  const int shapes = run.study.optimizer.iterations;
  const Quantity minimized = minimized_quantity(c);
  return {{"event", "begin"},
          {"program", program_text()},
          {"folder", run.folder.string()},
          {"title", run_title(c)},
          {"dimension", dim},
          {"resumed_after", started.resumed_after ? Json(*started.resumed_after) : Json()},
          {"iterations", shapes < unlimited_iterations ? Json(shapes) : Json()},
          {"objective",
           {{"quantity", minimizes_weighted_sum(c) ? "weighted_sum" : name(minimized)},
            {"unit", unit<dim>(kind(minimized))}}}};
}

template <int dim>
Json bounds(const OptimizationState<dim>& state) {
  Json result = Json::array();
  for (const BoundState& bound : bound_states(state.evaluation, state.memory.multipliers))
    result.push_back({{"name", bound.name},
                      {"value", bound.value},
                      {"relation", std::string(1, bound.relation)},
                      {"bound", bound.bound},
                      {"unit", unit<dim>(bound.unit)},
                      {"is_kept", bound.is_kept()}});
  return result;
}

template <int dim>
Json changes(const Trial<dim>& trial) {
  Json result = Json::array();
  for (const auto& event : trial.events) result.push_back(text(event));
  return result;
}

template <int dim>
Json accepted(const TrialDone<dim>& done, const RunView<dim>& run) {
  const PolarGrid<dim>& grid = run.study.grid();
  return {{"event", "shape"},
          {"iteration", done.state.iteration},
          {"objective", done.state.evaluation.function("objective").value},
          {"volume_fraction", volume_fraction(grid, done.state.measure)},
          {"step_m", done.trial.step * grid.resolution()},
          {"bounds", bounds(done.state)},
          {"changes", changes(done.trial)},
          {"seconds", done.seconds},
          {"elapsed_seconds", run.elapsed_seconds}};
}

template <int dim>
Json rejected(const TrialDone<dim>& done, const RunView<dim>& run) {
  const Trial<dim>& trial = done.trial;
  return {{"event", "rejected"},
          {"iteration", trial.iteration},
          {"reason", trial.failure ? to_string(trial.failure->reason) : to_string(trial.verdict)},
          {"detail", trial.failure ? trial.failure->detail : ""},
          {"objective", trial.evaluation ? Json(trial.evaluation->function("objective").value) : Json()},
          {"step_m", trial.step * run.study.grid().resolution()},
          {"seconds", done.seconds},
          {"elapsed_seconds", run.elapsed_seconds}};
}

/// Makes the lines of one event.
template <int dim>
struct Lines {
  const RunView<dim>& run;

  std::vector<Json> operator()(const RunStarted& started) const {
    std::vector<Json> lines{begin(started, run)};
    if (started.resumed_after) return lines;
    for (const std::string& text : warnings(run.study.source)) lines.push_back(warning("case", text));
    if (const auto change = volume_change_of_saved_shape<dim>(run.study.source))
      lines.push_back(message(text(*change)));
    return lines;
  }
  std::vector<Json> operator()(const TrialDone<dim>& done) const {
    return {done.trial.verdict == Verdict::accepted ? accepted(done, run) : rejected(done, run)};
  }
  std::vector<Json> operator()(const ContactAdvanced& advanced) const {
    const ContactProgress& contact = advanced.progress;
    return {{{"event", "contact"},
             {"position", contact.position},
             {"positions", contact.n_positions},
             {"newton_steps", contact.newton_steps},
             {"elapsed_seconds", run.elapsed_seconds}}};
  }
  std::vector<Json> operator()(const CommandDone& command) const {
    return {{{"event", "command"}, {"executed", command.was_executed}, {"text", command.text}}};
  }
  std::vector<Json> operator()(const CaseChanged& changed) const { return {message(changed.text)}; }
  std::vector<Json> operator()(const ShapeReplaced& replaced) const { return {message(replaced.text)}; }
  std::vector<Json> operator()(const GridChanged& changed) const { return {message(changed.text)}; }
  /// The end is the program's to tell, and StageFailed is a warning; no other event is of use to a program.
  template <class Other>
  std::vector<Json> operator()(const Other&) const {
    return {};
  }
};

}  // namespace

template <int dim>
void EventLines<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  for (const Json& json : std::visit(Lines<dim>{run}, event)) write_(line(json));
  for (const auto& [subject, text] : run_warnings(event, run)) write_(line(warning(subject, text)));
  if (saved_) write_(line({{"event", "checkpoint"}, {"iteration", *saved_}}));
  saved_.reset();
}

std::string end_line(const std::optional<StopReason>& reason, int exit_code, const std::string& meaning) {
  return line({{"event", "end"},
               {"reason", reason ? Json(to_string(*reason)) : Json()},
               {"exit_code", exit_code},
               {"meaning", meaning}});
}

template class EventLines<2>;
template class EventLines<3>;

}  // namespace wheelwright
