#include "wheelwright/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#ifdef WHEELWRIGHT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace wheelwright {

namespace {

/// Announces to the thread sanitizer, which sees neither this file nor TBB, that all calls of one
/// parallel_for() happen after the code before it and before the code after it, but in no order among
/// themselves.
class ForkAndJoin {
#ifdef WHEELWRIGHT_THREAD_SANITIZER
 public:
  ForkAndJoin() { __tsan_release(&fork_); }
  void call_begins() { __tsan_acquire(&fork_); }
  void call_ends() { __tsan_release(&join_); }
  ~ForkAndJoin() { __tsan_acquire(&join_); }

 private:
  char fork_ = 0, join_ = 0;
#else
 public:
  void call_begins() {}
  void call_ends() {}
#endif
};

}  // namespace

void parallel_for(int n, const std::function<void(int)>& f) {
  if (n == 1) return f(0);
  ForkAndJoin order;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, n, 1),
      [&](const auto& range) {
        order.call_begins();
        for (int i = range.begin(); i < range.end(); ++i) f(i);
        order.call_ends();
      },
      tbb::simple_partitioner());
}

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int n_threads)
    : control_(new Control{{tbb::global_control::max_allowed_parallelism, static_cast<size_t>(n_threads)}}) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace wheelwright
