#include "wheelwright/run/session/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/checkpoints/own_drawings.h"
#include "wheelwright/run/checkpoints/provenance.h"
#include "wheelwright/run/checkpoints/run_files.h"
#include "wheelwright/run/commands/stop_file.h"
#include "wheelwright/run/observers/observers.h"
#include "wheelwright/run/session/run_loop.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Whether the history contains trials after the initial shape, which is saved before them.
bool has_trials(const fs::path& history) {
  constexpr std::ptrdiff_t header_and_initial_shape = 2;
  std::ifstream file(history, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(file), {}, '\n') > header_and_initial_shape;
}

template <int dim>
bool is_finished(const Checkpoint<dim>& checkpoint, const Case& c) {
  if (!checkpoint.finished) return false;
  const OptimizerOptions options = optimizer_options<dim>(c);
  const bool is_done =
      checkpoint.finished == StopReason::no_descent ||
      (checkpoint.finished == StopReason::converged && options.tolerance >= checkpoint.tolerance);
  return is_done || reason_to_stop(options, checkpoint.state);
}

/// The expectations of the case for a run that ended there.
template <int dim>
Expected<std::vector<Finding>> findings_at(const Case& c, const Checkpoint<dim>& end) {
  if (c.expectations.empty()) return std::vector<Finding>{};
  const auto study = make_study<dim>(*with_radii_of(c, end.state.shape.lattice.grid()));
  if (!study) return study.failure();
  SolvedStates<dim> states = Failure{FailureReason::interrupted, "no expectation needs a solution"};
  const std::vector<Expectation> expectations = placed_expectations(c);
  if (need_a_solution(expectations))
    states = study->solver->states(end.state.shape, study->solver->all_positions(), Interrupt());
  return findings<dim>(expectations, end.found, *study->solver, study->load_cases, end.state, states);
}

template <int dim>
NotBegun<dim> already_finished(const Case& c, Checkpoint<dim> end, std::vector<UnusableCheckpoint> unusable) {
  auto found = findings_at(c, end);
  if (!found) return found.failure();
  return AlreadyFinished<dim>{std::move(end), *std::move(found), std::move(unusable)};
}

/// Whether the checkpoint's mean contact stress is one of this problem's tread.
template <int dim>
bool fits(const OptimizationState<dim>& state, const StateSolver<dim>& solver) {
  const Matrix& mean = state.evaluation.mean_observations;
  const TreadSurface<dim>& tread = solver.tread_surface();
  return mean.rows() == tread.rows().size() && mean.columns() == tread.n_columns;
}

/// If only the list of a run's files is missing, restores the entries that a checkpoint proves to be this
/// run's: the case, the history and the checkpoints.
template <int dim>
void restore_list(const Case& c, const fs::path& folder) {
  if (has_entry(folder / list_of_written_files)) return;
  const ResumePoint<dim> point = resume_point<dim>(folder, c);
  if (!point.newest) return;
  WrittenFiles written(folder);
  written.begin();
  for (const char* name : {"case.toml", history_file, "run.lock"}) written.list(name);
  written.list("checkpoints/");
}

}  // namespace

template <int dim>
Run<dim>::Run(FolderLock lock, fs::path folder, Study<dim> study, Resumption resumption,
              CheckpointFolder checkpoints, std::optional<Checkpoint<dim>> checkpoint)
    : lock_(std::move(lock)),
      folder_(std::move(folder)),
      study_(std::move(study)),
      resumption_(std::move(resumption)),
      checkpoint_(std::move(checkpoint)),
      observers_(make_observers<dim>(study_.source, checkpoints, checkpoint_)) {}

template <int dim>
Expected<Run<dim>, NotBegun<dim>> Run<dim>::begin(const Case& c, const fs::path& folder,
                                                  const PlaneSearch& search) {
  auto foreign = foreign_files(folder);
  if (StopFile(folder).exists()) foreign.emplace_back(stop_file);  // it would stop the run and be removed
  if (is_there(folder / "analysis.json"))
    foreign.emplace_back("analysis.json");  // its pictures are in the way
  if (!foreign.empty()) return NotBegun<dim>(ForeignFiles{std::move(foreign)});
  auto lock = FolderLock::acquire(folder);
  if (!lock) return NotBegun<dim>(lock.failure());
  const CheckpointFolder checkpoints(folder);
  if (is_there(folder / history_file) || checkpoints.exists()) return NotBegun<dim>(FolderHoldsARun{});
  const auto complete = with_parting_plane_found(with_own_drawings(c), search);
  if (!complete) return NotBegun<dim>(complete.failure());
  auto study = make_study<dim>(*complete);
  if (!study) return NotBegun<dim>(study.failure());
  return Run(*std::move(lock), folder, *std::move(study), {}, checkpoints, {});
}

template <int dim>
Expected<Run<dim>, NotBegun<dim>> Run<dim>::resume(const Case& given, const fs::path& folder) {
  const auto complete = with_parting_plane_found(given);
  if (!complete) return NotBegun<dim>(complete.failure());
  const Case& c = *complete;
  restore_list<dim>(c, folder);
  if (auto foreign = foreign_files(folder); !foreign.empty())
    return NotBegun<dim>(ForeignFiles{std::move(foreign)});
  auto lock = FolderLock::acquire(folder);
  if (!lock) return NotBegun<dim>(lock.failure());
  auto [checkpoints, checkpoint, unusable] = resume_point<dim>(folder, c);
  if (!checkpoint && !unusable.empty()) return NotBegun<dim>(NoUsableCheckpoint{std::move(unusable)});
  if (!checkpoint && has_trials(folder / history_file)) return NotBegun<dim>(CheckpointsGone{});
  if (checkpoint && is_finished(*checkpoint, c))
    return already_finished(c, *std::move(checkpoint), std::move(unusable));

  const int level = checkpoint ? *level_of(c, checkpoint->state.shape) : 0;
  auto study = make_study<dim>(
      checkpoint ? *with_radii_of(c, checkpoint->state.shape.lattice.grid(), level) : c, level);
  if (!study) return NotBegun<dim>(study.failure());
  Resumption resumption{.unusable = std::move(unusable), .shape = {}, .other_program = {}};
  if (checkpoint) {
    if (!fits(checkpoint->state, *study->solver))
      return NotBegun<dim>(CheckpointMisfit{"the checkpoint's mean contact stress does not fit the tread"});
    resumption.shape = checkpoint->state.iteration;
    if (checkpoint->provenance.program != program_text())
      resumption.other_program = checkpoint->provenance.program;
  }
  return Run(*std::move(lock), folder, *std::move(study), std::move(resumption), checkpoints,
             std::move(checkpoint));
}

template <int dim>
RunResult<dim> Run<dim>::execute(CommandQueue& commands, OnEnd on_end) {
  RunLoop<dim> loop(folder_, study_, observers_, commands, on_end);
  return checkpoint_ ? loop.resume(*checkpoint_) : loop.begin();
}

template class Run<2>;
template class Run<3>;

}  // namespace wheelwright
