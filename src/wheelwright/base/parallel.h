#pragma once

#include <functional>
#include <memory>

namespace wheelwright {

/// Calls f(0), ..., f(n - 1) on the threads that a ThreadLimit allows, in no particular order, and returns
/// when all are done. Calls must write to places of their own: then results do not depend on the number of
/// threads.
void parallel_for(int n, const std::function<void(int)>& f);

/// While it lives, parallel_for() uses at most so many threads. Without any: as many as there are processors.
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
