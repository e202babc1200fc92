#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace wheelwright {

void parallel_for(int n, const std::function<void(int)>& f) {
  if (n == 1) return f(0);
  tbb::parallel_for(
      tbb::blocked_range<int>(0, n, 1),
      [&](const auto& range) {
        for (int i = range.begin(); i < range.end(); ++i) f(i);
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
