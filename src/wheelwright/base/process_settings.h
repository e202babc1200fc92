#pragma once

#include <string>

namespace wheelwright {

/// For main(): keeps freed memory in the process, for the matrices of the next shape, which have the same
/// sizes. Returning and reallocating it costs a fifth of the time of a shape. Blocks above 32 MiB are
/// returned.
void keep_freed_memory();

/// Gives the freed memory that the process keeps back to the system, from all threads. A program that
/// computes for hours calls this now and then: what is in use lies scattered among what was freed, a little
/// worse after each change, and the process would grow by that. The next shape fetches what it needs again,
/// which takes about as long as one shape.
void give_freed_memory_back();

/// For the first line of main(): makes BLAS compute with one thread and its fastest kernels. BLAS reads these
/// settings from the environment before main(). If they differ, this restarts the program, in the same
/// process and with the same null-terminated arguments.
///
/// One thread, whatever the environment says: the library shares work out itself, and sums of BLAS would be
/// taken in an order that depends on the number of its threads. OpenBLAS may take a processor that is younger
/// than it is for an older one without AVX-512, whose kernels cost a fifth of the speed: the same ones on all
/// that have it, unless OPENBLAS_CORETYPE names others.
///
/// Returns if nothing is to be changed, or if the system cannot start the program again.
void restart_with_blas_settings(char* const* arguments);

/// For a library in a program of others, which cannot be restarted: BLAS computes with one thread while one
/// of these exists, and then with as many as before. That is a setting of the whole process: other users of
/// the same OpenBLAS see it too. Does nothing with another BLAS.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// What determines the last digits of results on this machine.
struct BlasSettings {
  std::string kernels;  ///< of OpenBLAS, e.g. "SkylakeX"; empty with another BLAS
  int threads;          ///< 0 with another BLAS
};

BlasSettings blas_settings();

}  // namespace wheelwright
