#include "wheelwright/app/commands/commands.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "wheelwright/app/commands/analyze.h"
#include "wheelwright/app/commands/resume.h"
#include "wheelwright/app/commands/run.h"
#include "wheelwright/app/commands/verify.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/files/output_error.h"

using namespace wheelwright;

namespace {

/// For the rest of the program: where a limit is lifted TBB starts threads, and ends the program when there
/// is no memory for them. The pointer stays, so that the leak sanitizer finds what it holds.
void limit_threads(int n_threads) {
  static const ThreadLimit* volatile limit = new ThreadLimit(n_threads);
  static_cast<void>(limit);
}

}  // namespace

extern "C" int wheelwright_command(const char* name, const Case* c, const RunOptions* options) {
  try {
    if (options->threads) limit_threads(*options->threads);
    if (std::string_view(name) == "run") return run_command(*c, *options);
    if (std::string_view(name) == "resume") return resume_command(*c, *options);
    if (std::string_view(name) == "analyze") return analyze_command(*c, *options);
    if (std::string_view(name) == "verify") return verify_command(*c, *options);
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
