#include "wheelwright/app/execute.h"

#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/terminal_observer.h"
#include "wheelwright/run/observers/event_lines.h"

namespace wheelwright {
namespace {

template <int dim>
int execute_with_events(Run<dim>& run, CommandQueue& commands, const Signals& signals, EventOutput& events) {
  run.add(std::make_unique<EventLines<dim>>([&events](const std::string& line) { events.write(line); }));
  const RunResult<dim> result = run.execute(commands);
  events.set_reason(result.reason);
  return exit_code_of(result, signals);
}

template <int dim>
int execute(Run<dim>& run, Signals& signals, const Reporting& reporting) {
  CommandQueue commands;
  commands.add_source([&signals] { return signals.next_command(); });
  if (reporting.events) return execute_with_events(run, commands, signals, *reporting.events);
  show_on_terminal(run, reporting.detail);
  return report_result(run.execute(commands), run.folder(), signals);
}

/// Returns where to print the results of a run that did not begin. With events, standard output is for lines
/// of JSON only.
std::FILE* stream_of_results(const Reporting& reporting) { return reporting.events ? stderr : stdout; }

/// On standard error, like the progress that follows.
PlaneSearch plane_search(const Signals& signals) {
  return {.interrupt = Interrupt([&signals] { return signals.stop().has_value(); }),
          .report = [](const std::string& line) { print_err("{}\n", line); }};
}

}  // namespace

int begin_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
              const Reporting& reporting) {
  if (signals.stop()) return report_not_begun_by_signal();
  return in_dimension_of(c, [&](auto dim) {
    auto run = Run<dim>::begin(c, folder, plane_search(signals));
    if (!run && signals.stop()) return report_not_begun_by_signal();
    if (!run) return report_not_begun<dim>(run.failure(), folder, stream_of_results(reporting));
    return execute(*run, signals, reporting);
  });
}

int resume_run(const Case& c, const std::filesystem::path& folder, Signals& signals,
               const Reporting& reporting) {
  return in_dimension_of(c, [&](auto dim) {
    auto run = Run<dim>::resume(c, folder);
    if (!run) return report_not_begun<dim>(run.failure(), folder, stream_of_results(reporting));
    report_resumption(run->resumption(), folder);
    return execute(*run, signals, reporting);
  });
}

}  // namespace wheelwright
