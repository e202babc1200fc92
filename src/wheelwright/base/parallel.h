#pragma once

#include <functional>
#include <memory>

namespace wheelwright {

/// Calls f(0), ..., f(n - 1) on as many threads as a ThreadLimit allows, in no particular order, and returns
/// when all calls are done. Each call must write to memory of its own; then the results do not depend on the
/// number of threads.
void parallel_for(int n, const std::function<void(int)>& f);

/// While an object lives, parallel_for() uses at most n_threads threads. Without any ThreadLimit it uses one
/// thread per processor.
class ThreadLimit {
 public:
  explicit ThreadLimit(int n_threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace wheelwright
