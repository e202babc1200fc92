#include "wheelwright/app/watch_status.h"

#include <fmt/format.h>

#include "wheelwright/app/terminal.h"
#include "wheelwright/case/shown_value.h"

namespace wheelwright {

template <int dim>
WatchStatus<dim>::~WatchStatus() {
  if (is_shown_ && repaints_) std::fputc('\n', stream_);
}

template <int dim>
void WatchStatus<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (std::holds_alternative<RunStarted>(event)) show_activity("computing the first shape");
  if (const auto* done = std::get_if<TrialDone<dim>>(&event)) {
    if (done->trial.verdict != Verdict::accepted) return;
    const double objective = done->state.evaluation.function("objective").value;
    const ShownUnit shown = shown_unit(run.study.source.objective.minimize, run.study.source.wheel);
    shape_ =
        fmt::format("shape {}, objective {:.5g} {} ({:+.2f} %), ", done->state.iteration,
                    objective * shown.factor, shown.name, 100 * (objective / run.initial->objective - 1));
    if (activity_.starts_with("computing")) activity_ = "optimizing";
    if (repaints_) show();
  }
  if (const auto* waits = std::get_if<RunWaits>(&event))
    show_activity(waits->reason ? "no better shape nearby: waiting for changes" : "paused");
  if (std::holds_alternative<RunProceeds>(event)) show_activity("optimizing");
  if (const auto* ended = std::get_if<RunEnded<dim>>(&event)) show_activity("ended");
}

template <int dim>
void WatchStatus<dim>::show_activity(const std::string& activity) {
  if (activity == activity_) return;
  activity_ = activity;
  is_shown_ = true;
  show();
}

template <int dim>
void WatchStatus<dim>::show() const {
  constexpr const char* clear_line = "\r\x1b[K";
  const std::string line = shape_ + activity_;
  std::fputs((repaints_ ? clear_line + line : line + '\n').c_str(), stream_);
  std::fflush(stream_);
}

template class WatchStatus<2>;
template class WatchStatus<3>;

}  // namespace wheelwright
