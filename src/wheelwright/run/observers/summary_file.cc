#include "wheelwright/run/observers/summary_file.h"

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright {

template <int dim>
void SummaryFile<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (!ended) return;
  const std::filesystem::path file = run.folder / "summary.json";
  if (ended->summary)
    write_atomically(file, summary_json(*ended->summary));
  else if (ended->reason == StopReason::failed_start)
    write_atomically(file, failure_json(run_title(run.study.source), *ended->failed_trials.back().failure));
}

template class SummaryFile<2>;
template class SummaryFile<3>;

}  // namespace wheelwright
