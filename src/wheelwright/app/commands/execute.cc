#include "wheelwright/app/commands/execute.h"

#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/terminal_observer.h"

namespace wheelwright {

template <int dim>
int execute(Run<dim>& run, Signals& signals) {
  CommandQueue commands;
  commands.add_source([&signals] { return signals.next_command(); });
  run.add(std::make_unique<TerminalObserver<dim>>());
  return report_result(run.execute(commands), run.folder(), signals);
}

template int execute(Run<2>&, Signals&);
template int execute(Run<3>&, Signals&);

}  // namespace wheelwright
