#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace wheelwright {

/// Calls f(0), ..., f(n - 1) on as many threads as a ThreadLimit allows, in no particular order, and returns
/// when all calls are done. Each call must write to memory of its own; then the results do not depend on the
/// number of threads.
void parallel_for(int n, const std::function<void(int)>& f);

/// Calls compute(0), ..., compute(n - 1) in the same way and take(i, result) for every i in ascending order,
/// on the calling thread. compute() may read what take() has gathered: it is that of the batches before, of
/// the same 64 indices for any number of threads.
template <class Compute, class Take>
void compute_in_parallel(int n, const Compute& compute, const Take& take) {
  constexpr int batch = 64;
  for (int first = 0; first < n; first += batch) {
    std::vector<decltype(compute(0))> results(std::min(batch, n - first));
    parallel_for(static_cast<int>(results.size()), [&](int k) { results[k] = compute(first + k); });
    for (std::size_t k = 0; k < results.size(); ++k) take(first + static_cast<int>(k), std::move(results[k]));
  }
}

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
