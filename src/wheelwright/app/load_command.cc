#include "wheelwright/app/load_command.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>

#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/terminal.h"

namespace wheelwright {

namespace {

/// Restricts BLAS to one thread, regardless of the environment: the program distributes the work itself, and
/// the order of the sums in BLAS would depend on its number of threads. OpenBLAS may mistake a processor
/// newer than itself for an older one without AVX-512, whose kernels are a fifth slower. This selects the
/// AVX-512 kernels on every processor that has them. BLAS reads these settings when the library is loaded.
void prepare_blas() {
  constexpr int replace = 1, keep = 0;
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"})
    setenv(name, "1", replace);
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    setenv("OPENBLAS_CORETYPE", "SkylakeX", keep);
#endif
}

}  // namespace

int load_and_run_command(const std::string& name, const Case& c, const RunOptions& options) {
  if (const auto lack = lack_of_memory(c, available_memory())) {
    tell("wheelwright {}: {}: {}\n", name, options.case_file.string(), *lack);
    return exit_refused;
  }
  prepare_blas();
  void* library = dlopen("libwheelwright_commands.so", RTLD_NOW);
  void* symbol = library ? dlsym(library, "wheelwright_command") : nullptr;
  if (!symbol) {
    tell("wheelwright: cannot load the solver: {}\n", dlerror());
    return exit_input_output;
  }
  return reinterpret_cast<decltype(&wheelwright_command)>(symbol)(name.c_str(), &c, &options);
}

}  // namespace wheelwright
