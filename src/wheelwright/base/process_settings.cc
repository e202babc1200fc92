#include "wheelwright/base/process_settings.h"

#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <string_view>

#include "wheelwright/base/fastest_kernels.h"

// Of OpenBLAS; null in a process that has another BLAS.
extern "C" {
__attribute__((weak)) void openblas_set_num_threads(int);
__attribute__((weak)) int openblas_get_num_threads();
__attribute__((weak)) char* openblas_get_corename();
}

namespace wheelwright {

namespace {

/// Sets the variable; returns whether its value changed.
bool set(const char* name, std::string_view value) {
  const char* before = std::getenv(name);
  if (before && before == value) return false;
  setenv(name, value.data(), 1);
  return true;
}

/// The number of those who want one thread, and the number of threads before.
struct OneThreadWanted {
  std::mutex mutex;
  int by = 0;
  int before = 0;
};

OneThreadWanted& one_thread_wanted() {
  static OneThreadWanted wanted;
  return wanted;
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
  if (const char* kernels = fastest_kernels(); kernels && !std::getenv("OPENBLAS_CORETYPE"))
    changed |= set("OPENBLAS_CORETYPE", kernels);
  if (changed) execv("/proc/self/exe", arguments);
}

OneBlasThread::OneBlasThread() {
  if (!openblas_set_num_threads || !openblas_get_num_threads) return;
  OneThreadWanted& wanted = one_thread_wanted();
  const std::scoped_lock lock(wanted.mutex);
  if (wanted.by++ > 0) return;
  wanted.before = openblas_get_num_threads();
  if (wanted.before != 1) openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (!openblas_set_num_threads || !openblas_get_num_threads) return;
  OneThreadWanted& wanted = one_thread_wanted();
  const std::scoped_lock lock(wanted.mutex);
  if (--wanted.by == 0 && wanted.before != 1) openblas_set_num_threads(wanted.before);
}

BlasSettings blas_settings() {
  return {openblas_get_corename ? openblas_get_corename() : "",
          openblas_get_num_threads ? openblas_get_num_threads() : 0};
}

}  // namespace wheelwright
