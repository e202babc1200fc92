#include "wheelwright/app/commands/run.h"

#include "wheelwright/app/commands/execute.h"
#include "wheelwright/app/run_messages.h"

namespace wheelwright {

int run_command(const Case& c, const RunOptions& options) {
  const std::filesystem::path folder = options.output.value_or(c.output.folder);
  return in_dimension_of(c, [&](auto dim) {
    Signals signals;
    auto run = Run<dim>::begin(c, folder);
    if (!run) return report_not_begun<dim>(run.failure(), folder);
    return execute(*run, signals);
  });
}

}  // namespace wheelwright
