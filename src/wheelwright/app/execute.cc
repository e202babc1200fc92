#include "wheelwright/app/execute.h"

#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/terminal_observer.h"

namespace wheelwright {
namespace {

template <int dim>
int execute(Run<dim>& run, Signals& signals, Detail detail) {
  CommandQueue commands;
  commands.add_source([&signals] { return signals.next_command(); });
  show_on_terminal(run, detail);
  return report_result(run.execute(commands), run.folder(), signals);
}

}  // namespace

int begin_run(const Case& c, const std::filesystem::path& folder, Signals& signals, Detail detail) {
  if (signals.stop()) return report_not_begun_by_signal();
  return in_dimension_of(c, [&](auto dim) {
    auto run = Run<dim>::begin(c, folder);
    if (!run) return report_not_begun<dim>(run.failure(), folder);
    return execute(*run, signals, detail);
  });
}

int resume_run(const Case& c, const std::filesystem::path& folder, Signals& signals, Detail detail) {
  return in_dimension_of(c, [&](auto dim) {
    auto run = Run<dim>::resume(c, folder);
    if (!run) return report_not_begun<dim>(run.failure(), folder);
    report_resumption(run->resumption(), folder);
    return execute(*run, signals, detail);
  });
}

}  // namespace wheelwright
