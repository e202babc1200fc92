#include "app/load_command.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>

#include "app/commands/commands.h"
#include "app/exit_code.h"
#include "app/memory.h"

namespace wheelwright {

namespace {

/// The matrices are too small for threads to pay, of BLAS or of CHOLMOD, which opens four whatever
/// OMP_NUM_THREADS says; and sums would be taken in an order that depends on their number. Read when the
/// library is loaded.
void hold_to_one_thread() {
  constexpr int replace = 1;
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"})
    setenv(name, "1", replace);
}

}  // namespace

int load_and_run_command(const std::string& name, const Case& c, const RunOptions& options) {
  if (const auto lack = lack_of_memory(c, available_memory())) {
    fmt::print(stderr, "wheelwright {}: {}: {}\n", name, options.case_file.string(), *lack);
    return exit_refused;
  }
  hold_to_one_thread();
  void* library = dlopen("libwheelwright_commands.so", RTLD_NOW);
  void* symbol = library ? dlsym(library, "wheelwright_command") : nullptr;
  if (!symbol) {
    fmt::print(stderr, "wheelwright: cannot load the solver: {}\n", dlerror());
    return exit_input_output;
  }
  return reinterpret_cast<decltype(&wheelwright_command)>(symbol)(name.c_str(), &c, &options);
}

}  // namespace wheelwright
