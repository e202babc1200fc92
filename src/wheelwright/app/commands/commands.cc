#include "wheelwright/app/commands/commands.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <system_error>

#include "wheelwright/app/commands/analyze.h"
#include "wheelwright/app/commands/resume.h"
#include "wheelwright/app/commands/run.h"
#include "wheelwright/app/commands/verify.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/files/output_error.h"

namespace wheelwright {
namespace {

/// For the rest of the program: where a limit is lifted TBB starts threads, and ends the program when there
/// is no memory for them. The pointer stays, so that the leak sanitizer finds what it holds.
void limit_threads(int n_threads) {
  static const ThreadLimit* volatile limit = new ThreadLimit(n_threads);
  static_cast<void>(limit);
}

}  // namespace

int run_command_named(const std::string& name, const Case& c, const RunOptions& options) {
  if (const auto lack = lack_of_memory(c, available_memory())) {
    tell("wheelwright {}: {}: {}\n", name, options.case_file.string(), *lack);
    return exit_refused;
  }
  try {
    if (options.threads) limit_threads(*options.threads);
    if (name == "run") return run_command(c, options);
    if (name == "resume") return resume_command(c, options);
    if (name == "analyze") return analyze_command(c, options);
    if (name == "verify") return verify_command(c, options);
    tell("wheelwright: no command {}\n", name);
  } catch (const OutputError& error) {
    tell("wheelwright {}: {}\n", name, error.what());
    return exit_input_output;
  } catch (const std::bad_alloc&) {
    tell("wheelwright {}: the memory is used up; take fewer cells or load positions\n", name);
    return exit_refused;
  } catch (const std::system_error& error) {
    tell("wheelwright {}: {}\n", name, error.what());
    return exit_input_output;
  } catch (const std::exception& error) {
    tell("wheelwright {}: bug: {}\n", name, error.what());
  }
  return exit_bug;
}

}  // namespace wheelwright
