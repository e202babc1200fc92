#include "wheelwright/design/explore/shared_work.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <numeric>
#include <thread>

#include "wheelwright/design/explore/workers.h"

namespace wheelwright {
namespace {

constexpr std::chrono::milliseconds between_attempts{200};

/// Works on a thing unless another process holds it. Returns that process.
std::optional<FolderInUse> attempt(int i, const SharedWork& shared) {
  const auto lock = FileLock::acquire(shared.lock(i));
  return lock ? shared.work(i) : std::optional(lock.failure());
}

/// Attempts all things. Returns those that others hold and that are to be attempted again.
std::vector<int> held_by_others(int n_threads, const std::vector<int>& things, const SharedWork& shared) {
  std::vector<int> held;
  std::mutex mutex;
  on_threads(n_threads, static_cast<int>(things.size()), [&](int k) {
    const auto holder = attempt(things[k], shared);
    if (!holder || !shared.waits(things[k], *holder)) return;
    const std::scoped_lock lock(mutex);
    held.push_back(things[k]);
  });
  std::ranges::sort(held);
  return held;
}

}  // namespace

void share_work(int n_threads, int n, const SharedWork& shared) {
  std::vector<int> things(n);
  std::iota(things.begin(), things.end(), 0);
  for (things = held_by_others(n_threads, things, shared); !things.empty();
       things = held_by_others(n_threads, things, shared))
    std::this_thread::sleep_for(between_attempts);
}

}  // namespace wheelwright
