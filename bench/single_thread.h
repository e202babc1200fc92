#pragma once

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace wheelwright::bench {

/// Times are those of one thread with the kernels that `wheelwright` uses: starts the program again with one
/// thread for OpenBLAS and OpenMP (in CHOLMOD) unless it runs so already. The libraries read these variables
/// when they are loaded, so that setting them here alone would be too late.
inline void restart_single_threaded(char** arguments) {
  bool restart = false;
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_THREAD_LIMIT"}) {
    const char* threads = std::getenv(variable);
    if (threads && std::string_view(threads) == "1") continue;
    setenv(variable, "1", 1);
    restart = true;
  }
  // As the program does: OpenBLAS may not know processors that are younger than it is.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
      !std::getenv("OPENBLAS_CORETYPE")) {
    setenv("OPENBLAS_CORETYPE", "SkylakeX", 1);
    restart = true;
  }
  if (restart) execv("/proc/self/exe", arguments);
}

}  // namespace wheelwright::bench
