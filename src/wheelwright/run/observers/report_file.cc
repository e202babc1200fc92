#include "wheelwright/run/observers/report_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <utility>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/run/observers/run_report.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {
namespace {

constexpr const char* page_file = "report.html";
constexpr double least_seconds_between_pages = 5;
constexpr double most_share_of_time = 0.01;

/// Keeps the lines of the shapes up to the one from which the run continues.
void keep_outlines(const std::filesystem::path& folder, std::optional<int> resumed_after) {
  std::string kept;
  std::ifstream stream(folder / outline_file);
  for (std::string line; resumed_after && std::getline(stream, line);)
    if (const auto outline = parse_outline_line(line); outline && outline->shape <= *resumed_after)
      kept += line + '\n';
  write_atomically(folder / outline_file, kept);
}

void add_outline(const std::filesystem::path& folder, const ShapeOutline& outline) {
  const auto path = folder / outline_file;
  std::ofstream stream(path, std::ios::app | std::ios::binary);
  if (!(stream << outline_line(outline)).flush()) throw OutputError(path, errno);
}

template <int dim>
SolvedShape<dim> last_shape(const RunEnded<dim>& ended) {
  return {&ended.state->shape, ended.solver, ended.solution};
}

}  // namespace

template <int dim>
void ReportFile<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* started = std::get_if<RunStarted>(&event))
    keep_outlines(run.folder, started->resumed_after);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event);
      done && done->trial.verdict == Verdict::accepted) {
    add_outline(run.folder,
                shape_outline(done->state.iteration, done->state.evaluation.function("objective").value,
                              mid_plane_section(done->state.shape)));
    waited_ += clock_.lap();
    if (waited_ >= std::max(wait_, least_seconds_between_pages)) {
      write_atomically(run.folder / page_file,
                       report_page({page_run(report_of_folder<dim>(run.folder, run.study.source))}));
      waited_ = 0;
      wait_ = clock_.lap() / most_share_of_time;
    }
  }
  if (const auto* shown = std::get_if<PositionShown<dim>>(&event)) {
    if (!positions_) positions_.emplace(last_shape(shown->ended));
    positions_->add(shown->position, shown->fields);
  }
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (ended && (ended->state || ended->reason == StopReason::failed_start))
    write_atomically(run.folder / page_file, report_page({page_run(report_of_end(*ended, run))}));
}

template <int dim>
ReportRun<dim> ReportFile<dim>::report_of_end(const RunEnded<dim>& ended, const RunView<dim>& run) {
  if (!ended.solution) return report_without_results<dim>(run.folder, run.study.source, ended.reason);
  ShownPositions<dim> positions = *std::exchange(positions_, std::nullopt);
  return report_of_results<dim>(run.folder, run.study.source, *ended.summary, last_shape(ended),
                                std::move(positions).wheel(), ended.reason);
}

template class ReportFile<2>;
template class ReportFile<3>;

}  // namespace wheelwright
