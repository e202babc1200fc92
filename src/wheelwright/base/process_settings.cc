#include "wheelwright/base/process_settings.h"

#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace wheelwright {

namespace {

/// Sets the variable; returns whether its value changed.
bool set(const char* name, std::string_view value) {
  const char* before = std::getenv(name);
  if (before && before == value) return false;
  setenv(name, value.data(), 1);
  return true;
}

bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

}  // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
#endif
}

void give_freed_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void restart_with_blas_settings(char* const* arguments) {
  bool changed = false;
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"})
    changed |= set(name, "1");
  if (!std::getenv("OPENBLAS_CORETYPE") && has_avx512()) changed |= set("OPENBLAS_CORETYPE", "SkylakeX");
  if (changed) execv("/proc/self/exe", arguments);
}

}  // namespace wheelwright
