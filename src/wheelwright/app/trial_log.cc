#include "wheelwright/app/trial_log.h"

#include <fmt/format.h>

#include "wheelwright/base/text.h"

namespace wheelwright {
namespace {

template <int dim>
std::string reason(const Trial<dim>& trial) {
  return trial.failure ? fmt::format("{} ({})", to_string(trial.failure->reason), trial.failure->detail)
                       : to_string(trial.verdict);
}

}  // namespace

template <int dim>
void TrialLog<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (std::holds_alternative<RunStarted>(event)) begin(run.study);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event)) tell_trial(*done);
  if (const auto* changed = std::get_if<GridChanged>(&event))
    progress_->note("continuing with the " + changed->text);
}

template <int dim>
void TrialLog<dim>::begin(const Study<dim>& study) {
  const WeightedSum<dim>& terms = study.objective().terms;
  for (const auto& [weight, functional, load_case, _] : terms)
    if (terms.size() > 1)
      progress_->note(fmt::format("objective: {:.6g} * {}", weight,
                                  name_in_case(functional->name(), study.load_cases, load_case)));
}

template <int dim>
void TrialLog<dim>::tell_trial(const TrialDone<dim>& done) {
  const Trial<dim>& trial = done.trial;
  if (trial.verdict != Verdict::accepted) {
    const std::string halved = trial.step > 0 ? fmt::format(", step {:.3g} cells halved", trial.step) : "";
    progress_->note(fmt::format("shape {}: {}{}", trial.iteration, reason(trial), halved));
    return;
  }
  for (const auto& event : trial.events)
    progress_->note(fmt::format("shape {}: {}", trial.iteration, text(event)));
}

template class TrialLog<2>;
template class TrialLog<3>;

}  // namespace wheelwright
