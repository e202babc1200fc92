#include "wheelwright/app/commands/resume.h"

#include "wheelwright/app/commands/execute.h"
#include "wheelwright/app/run_messages.h"

namespace wheelwright {

int resume_command(const Case& c, const RunOptions& options) {
  const std::filesystem::path& folder = options.run_folder;
  return in_dimension_of(c, [&](auto dim) {
    Signals signals;
    auto run = Run<dim>::resume(c, folder);
    if (!run) return report_not_begun<dim>(run.failure(), folder);
    report_resumption(run->resumption(), folder);
    return execute(*run, signals);
  });
}

}  // namespace wheelwright
