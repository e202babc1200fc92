#include "wheelwright/design/explore/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace wheelwright {

void on_threads(int n_threads, int n, const std::function<void(int)>& work) {
  std::atomic<int> next = 0;
  std::exception_ptr first;
  std::mutex mutex;
  const auto take_turns = [&] {
    for (int i = next++; i < n; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!first) first = std::current_exception();
        next = n;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int k = 1; k < std::min(n_threads, n); ++k) threads.emplace_back(take_turns);
    take_turns();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace wheelwright
