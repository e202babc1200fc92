#include "wheelwright/run/session/run_end.h"

#include "wheelwright/case/layers.h"

namespace wheelwright {
namespace {

template <int dim>
RunResult<dim> result(const Session<dim>& session, const Journal<dim>& journal, StopReason reason) {
  RunResult<dim> of_run{.reason = reason,
                        .state = {},
                        .initial = {},
                        .failed_trials = journal.failed_trials(),
                        .findings = {},
                        .summary = {},
                        .elapsed_seconds = journal.elapsed_seconds()};
  if (!session.has_shape()) return of_run;
  of_run.state = session.state();
  of_run.initial = *session.initial();
  of_run.is_approaching = is_approaching(session.study().optimizer, session.state());
  return of_run;
}

/// For the expectations of the case, of which the observers noted what earlier shapes tell.
template <int dim>
std::vector<Finding> findings_at_the_end(const Session<dim>& session, const Journal<dim>& journal,
                                         const SolvedStates<dim>& solution) {
  const Study<dim>& study = session.study();
  if (study.source.expectations.empty()) return {};
  Checkpoint<dim> noted{.provenance = {},
                        .state = session.state(),
                        .initial = *session.initial(),
                        .nucleation = {},
                        .found = {},
                        .history = {},
                        .elapsed_seconds = 0,
                        .finished = {}};
  for (const auto& observer : journal.observers()) observer->add_to(noted);
  return findings<dim>(placed_expectations(study.source), noted.found, *study.solver, study.load_cases,
                       session.state(), solution);
}

}  // namespace

template <int dim>
RunResult<dim> end_run(const Session<dim>& session, const Journal<dim>& journal, StopReason reason,
                       const Interrupt& interrupt) {
  const auto results =
      final_results(session.study(), *session.initial(), session.state(), journal.solved(), interrupt);
  if (results.is_interrupted && reason != StopReason::gave_up)
    reason = StopReason::stop_requested;  // a resumed run completes them
  const RunEnded<dim> ended{
      reason,           &session.state(),       results.shown.get(), results.solver.get(),
      &results.summary, journal.failed_trials()};
  if (results.shown)
    for_each_position<dim>(*results.solver, *results.shown,
                           [&](int position, const PositionFields<dim>& fields) {
                             journal.notify(PositionShown<dim>{ended, position, fields});
                           });
  journal.notify(ended);
  RunResult<dim> of_run = result(session, journal, reason);
  of_run.summary = results.summary;
  if (reason != StopReason::stop_requested)
    of_run.findings = findings_at_the_end(session, journal, results.own);
  return of_run;
}

template <int dim>
RunResult<dim> end_without_shape(const Session<dim>& session, Journal<dim>& journal, const Failure& failure) {
  const bool is_stopped = failure.reason == FailureReason::interrupted;
  const StopReason reason = is_stopped ? StopReason::stop_requested : StopReason::failed_start;
  if (!is_stopped) journal.set_failed(0, session.study().initial, failure);
  journal.notify(RunEnded<dim>{reason, nullptr, nullptr, nullptr, nullptr, journal.failed_trials()});
  return result(session, journal, reason);
}

template decltype(end_run<2>) end_run<2>;
template decltype(end_run<3>) end_run<3>;
template decltype(end_without_shape<2>) end_without_shape<2>;
template decltype(end_without_shape<3>) end_without_shape<3>;

}  // namespace wheelwright
