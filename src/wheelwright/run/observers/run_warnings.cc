#include "wheelwright/run/observers/run_warnings.h"

#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/run/study/feature_warnings.h"
#include "wheelwright/run/study/fitting.h"
#include "wheelwright/run/study/roughness_warning.h"

namespace wheelwright {
namespace {

template <int dim>
std::vector<RunWarning> of_start(const RunView<dim>& run) {
  std::vector<RunWarning> warnings;
  for (const auto& event : lost_on_the_grid<dim>(run.study.source))
    warnings.push_back({"initial shape", "the grid is too coarse for the holes of the case: " + text(event)});
  if (const auto fitting = fitting_of_initial_shape<dim>(run.study.source))
    warnings.push_back({"initial shape", *fitting});
  return warnings;
}

template <int dim>
std::vector<RunWarning> of_first_shape(const Trial<dim>& trial, const RunView<dim>& run) {
  return {{"initial shape",
           deformation_warning(deformation_size(*run.study.solver, trial.shape, *trial.solution))}};
}

template <int dim>
std::vector<RunWarning> of_result(const RunSummary<dim>& summary, const RunView<dim>& run) {
  const Case& c = run.study.source;
  const DescribedWheel<dim>& wheel = summary.after.wheel;
  std::vector<std::string> texts;
  if (wheel.loaded) texts.push_back(deformation_warning(wheel.loaded->deformation));
  for (std::string& warning : too_warm(wheel)) texts.push_back(std::move(warning));
  if (wheel.outline)
    for (std::string& warning : feature_warnings(c, *wheel.outline)) texts.push_back(std::move(warning));
  texts.push_back(roughness_warning(c, roughness(wheel), roughness(summary.before.wheel)));
  std::vector<RunWarning> warnings;
  for (std::string& text : texts) warnings.push_back({"last shape", std::move(text)});
  return warnings;
}

/// Some of the texts may be empty.
template <int dim>
std::vector<RunWarning> possible_warnings(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* started = std::get_if<RunStarted>(&event); started && !started->resumed_after)
    return of_start(run);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event))
    if (done->trial.verdict == Verdict::accepted && done->state.iteration == 0 && done->trial.solution)
      return of_first_shape(done->trial, run);
  if (const auto* failed = std::get_if<StageFailed>(&event)) return {{failed->stage, failed->reason}};
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event); ended && ended->summary)
    return of_result(*ended->summary, run);
  return {};
}

}  // namespace

template <int dim>
std::vector<RunWarning> run_warnings(const Event<dim>& event, const RunView<dim>& run) {
  std::vector<RunWarning> warnings = possible_warnings(event, run);
  std::erase_if(warnings, [](const RunWarning& warning) { return warning.text.empty(); });
  return warnings;
}

template decltype(run_warnings<2>) run_warnings<2>;
template decltype(run_warnings<3>) run_warnings<3>;

}  // namespace wheelwright
