#pragma once

#include <functional>

namespace wheelwright {

/// Calls work(0), ..., work(n - 1) on `n_threads` threads, each number once and started in this order, and
/// returns when all calls are done. After an exception no further call starts; the first one is rethrown at
/// the end. A ThreadLimit limits the threads that parallel_for() adds to these within the calls.
void on_threads(int n_threads, int n, const std::function<void(int)>& work);

}  // namespace wheelwright
