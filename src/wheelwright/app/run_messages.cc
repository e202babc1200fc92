#include "wheelwright/app/run_messages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <csignal>

#include "wheelwright/app/terminal.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/output/report/gains.h"
#include "wheelwright/run/observers/failure_report.h"
#include "wheelwright/run/results/stop_text.h"
#include "wheelwright/run/study/bounded_functions.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

int exit_code_of(const std::vector<Finding>& findings) {
  return std::ranges::all_of(findings, &Finding::met) ? exit_done : exit_unexpected;
}

template <int dim>
int exit_code_of(const OptimizationState<dim>& last, const std::vector<Finding>& findings) {
  const auto bounds = bound_states(last.evaluation, last.memory.multipliers);
  return std::ranges::all_of(bounds, &BoundState::is_kept) ? exit_code_of(findings) : exit_infeasible;
}

/// Prints expected and actual values.
void report_findings(const std::vector<Finding>& findings, std::FILE* stream) {
  const auto unmet = std::ranges::count_if(findings, [](const Finding& f) { return !f.met(); });
  if (!findings.empty())
    print_to(stream, "expected   {} of {} values found\n", findings.size() - unmet, findings.size());
  for (const Finding& finding : findings)
    if (!finding.met()) print_err("wheelwright: {}\n", finding.text());
}

/// Whether a finer grid keeps a bound too, as far as is known.
bool is_kept_on_finer_grid(const BoundState& bound, const std::vector<SummarizedBound>& checked) {
  const auto found = std::ranges::find_if(checked, [&](const SummarizedBound& one) {
    return one.name == bound.name && one.relation == bound.relation;
  });
  return found != checked.end() && found->finer && *found->finer &&
         (*found->finer)->verdict == FinerVerdict::kept;
}

/// Prints which bounds the last shape keeps; `checked`: on a finer grid too.
template <int dim>
void report_bounds(const OptimizationState<dim>& state, std::FILE* stream,
                   const std::vector<SummarizedBound>& checked = {}) {
  for (const BoundState& bound : bound_states(state.evaluation, state.memory.multipliers)) {
    const std::string line = text(bound, state.shape.lattice.grid());
    if (bound.is_kept())
      print_to(stream, "bound      {}{}\n", line,
               is_kept_on_finer_grid(bound, checked) ? ", on a finer grid too" : "");
    else
      print_err("wheelwright: bound {}\n", line);
  }
  for (const SummarizedBound& bound : checked)
    if (const std::string warning = finer_grid_warning(bound); !warning.empty())
      print_to(stream, "           {}\n", warning);
}

/// One overload for each reason not to start.
template <int dim>
struct NotBegunReport {
  const fs::path& folder;
  std::FILE* stream;  ///< of results

  int operator()(const FolderInUse& in_use) const {
    print_err("{}: {} is writing to this folder\n", folder.string(), to_string(in_use));
    return exit_refused;
  }
  int operator()(const FolderHoldsARun&) const {
    print_err(
        "{0}: already contains a run; `wheelwright resume {0}` continues it; for a new one choose another "
        "folder with --output, or remove this one\n",
        folder.string());
    return exit_refused;
  }
  int operator()(const ForeignFiles& foreign) const {
    print_err(
        "{}: {}: already exists and was not written by a run, so it is not replaced; move it away, or "
        "choose another folder with --output\n",
        folder.string(), fmt::format("{}", fmt::join(foreign.names, ", ")));
    return exit_refused;
  }
  int operator()(const CheckpointsGone&) const {
    print_err("{}: its checkpoints are missing; it cannot continue\n", folder.string());
    return exit_checkpoint;
  }
  int operator()(const NoUsableCheckpoint& none) const {
    report_unusable(none.unusable);
    print_err("{}: no usable checkpoint\n", folder.string());
    return exit_checkpoint;
  }
  int operator()(const CheckpointMisfit& misfit) const {
    print_err("{}: {}\n", folder.string(), misfit.reason);
    return exit_checkpoint;
  }
  int operator()(const AlreadyFinished<dim>& finished) const {
    report_unusable(finished.unusable);
    const Checkpoint<dim>& end = finished.end;
    print_to(stream, "{}: finished: {} shapes ({})\n", folder.string(), end.state.iteration,
             text(*end.finished));
    if (end.finished == StopReason::iterations)
      print_to(stream, "to extend it: wheelwright resume {} --iterations N\n", folder.string());
    report_bounds(end.state, stream);
    report_findings(finished.findings, stream);
    return exit_code_of(end.state, finished.findings);
  }
  int operator()(const Failure& failure) const {
    print_err("wheelwright: {}\n", to_string(failure));
    return exit_no_solution;
  }
};

/// The files to look at first.
void print_files(const fs::path& folder) {
  for (const auto& [file, meaning] : {std::pair{"report.html", "everything on one page, for a browser"},
                                      {"comparison.svg", "before and after"},
                                      {"shape.svg", "the shape at true scale, for cutting"},
                                      {"shape.stl", "the shape as a closed surface, in millimetres"}})
    if (is_there(folder / file)) print("  {:<36} {}\n", (folder / file).string(), meaning);
}

template <int dim>
void print_summary(const RunResult<dim>& result, const fs::path& folder) {
  const PolarGrid<dim>& grid = result.state->shape.lattice.grid();
  print("{} shapes in {:.1f} s: {}\n", result.state->iteration, result.elapsed_seconds, text(result.reason));
  if (result.summary)
    print_lines(stdout, fmt::format("\n{}\n{}\n\n", summary_table(*result.summary), gains(*result.summary)));
  if (result.is_approaching && result.reason != StopReason::gave_up)
    print("volume.target = {:.6g} was not reached: use more shapes, or a larger volume.rate\n",
          volume_fraction(grid, result.state->target_measure));
  print_files(folder);
}

template <int dim>
void report_failure(const RunResult<dim>& result, const fs::path& folder) {
  print_err("wheelwright: {}\n",
            failure_headline<dim>(result.state ? &*result.state : nullptr, result.failed_trials));
  if (result.state)
    if (const std::string hint = volume_hint(*result.initial, *result.state); !hint.empty())
      print_err("wheelwright: {}\n", hint);
  const auto line = [&](const char* file, const char* meaning) {
    if (is_there(folder / file)) print_err("  {:<36} {}\n", (folder / file).string(), meaning);
  };
  line(failure_report_file, "every failed trial, and the contents of this folder");
  line(rejected_picture_file, "the shape that failed");
}

template <int dim>
void tell_stop(const RunResult<dim>& result, const fs::path& folder) {
  if (result.state)
    print_err("stopped after {} shapes, saved; to continue: wheelwright resume {}\n", result.state->iteration,
              folder.string());
  else
    print_err(
        "stopped before the first shape was evaluated, so nothing is saved; to start again: wheelwright "
        "resume {}\n",
        folder.string());
}

ExitCode exit_code_of_stop(const Signals& signals) {
  const auto signal = signals.stop();
  return signal == SIGINT ? exit_interrupted : signal == SIGHUP ? exit_hung_up : exit_terminated;
}

}  // namespace

void report_unusable(const std::vector<UnusableCheckpoint>& unusable) {
  for (const auto& [file, reason] : unusable)
    print_err("{}: unusable, trying the one before it: {}\n", file.string(), reason);
}

template <int dim>
int report_not_begun(const NotBegun<dim>& reason, const fs::path& folder, std::FILE* stream) {
  return std::visit(NotBegunReport<dim>{folder, stream}, reason);
}

int report_not_begun_by_signal() {
  print_err("stopped before the run started; nothing was written\n");
  return exit_nothing_saved;
}

void report_resumption(const Resumption& resumption, const fs::path& folder) {
  report_unusable(resumption.unusable);
  if (!resumption.shape) {
    print_err("{}: no checkpoint yet; the run starts from the beginning\n", folder.string());
    return;
  }
  if (resumption.other_program)
    print_err("warning: saved by {}; the last digits may differ from those of an uninterrupted run\n",
              *resumption.other_program);
  print_err("{}: resuming after shape {}\n", folder.string(), *resumption.shape);
}

template <int dim>
int exit_code_of(const RunResult<dim>& result, const Signals& signals) {
  if (result.reason == StopReason::stop_requested)
    return result.state ? exit_code_of_stop(signals) : exit_nothing_saved;
  if (result.reason == StopReason::failed_start || result.reason == StopReason::gave_up)
    return exit_no_solution;
  return exit_code_of(*result.state, result.findings);
}

template <int dim>
int report_result(const RunResult<dim>& result, const fs::path& folder, const Signals& signals) {
  const int code = exit_code_of(result, signals);
  if (result.reason == StopReason::stop_requested) {
    tell_stop(result, folder);
    if (result.state) print_files(folder);
    return code;
  }
  if (result.reason != StopReason::failed_start) print_summary(result, folder);
  if (code == exit_no_solution) {
    report_failure(result, folder);
    return code;
  }
  report_bounds(*result.state, stdout,
                result.summary ? result.summary->bounds : std::vector<SummarizedBound>());
  if (result.summary && !result.summary->bounded_peaks.empty())
    print("           {}\n", result.summary->bounded_peaks);
  report_findings(result.findings, stdout);
  return code;
}

template decltype(report_not_begun<2>) report_not_begun<2>;
template int exit_code_of(const RunResult<2>&, const Signals&);
template decltype(report_result<2>) report_result<2>;
template decltype(report_not_begun<3>) report_not_begun<3>;
template int exit_code_of(const RunResult<3>&, const Signals&);
template decltype(report_result<3>) report_result<3>;

}  // namespace wheelwright
