#include "wheelwright/run/summary_file.h"

#include "wheelwright/files/atomic_file.h"

namespace wheelwright {

template <int dim>
void SummaryFile<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (ended && ended->summary) write_atomically(run.folder / "summary.json", summary_json(*ended->summary));
}

template class SummaryFile<2>;
template class SummaryFile<3>;

}  // namespace wheelwright
