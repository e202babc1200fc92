#include "wheelwright/app/commands/run.h"

#include <fmt/format.h>

#include "wheelwright/run/optimize_case.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"

namespace wheelwright {
namespace {

int begin(const Case& c, const std::filesystem::path& folder) {
  const CheckpointFolder checkpoints(folder);
  if (!std::filesystem::exists(folder / "history.csv") && !checkpoints.exists())
    return optimize_case(c, {folder, checkpoints});
  tell(
      "{0}: holds a run already; `wheelwright resume {0}` goes on with it; for a new one choose another "
      "folder with --output, or remove this one\n",
      folder.string());
  return exit_refused;
}

}  // namespace

int run_command(const Case& c, const RunOptions& options) {
  const std::filesystem::path folder = options.output.value_or(c.output.folder);
  return in_locked_folder(folder, [&] { return begin(c, folder); });
}

}  // namespace wheelwright
