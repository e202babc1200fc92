#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "wheelwright/run/checkpoints/folder_lock.h"

namespace wheelwright {

/// Work on several things that other processes may be working on too.
struct SharedWork {
  /// The file that is locked while a thing is worked on, by its index.
  std::function<std::filesystem::path(int)> lock;
  /// Called while this process holds the lock. Returns who keeps the thing from being worked on nevertheless.
  std::function<std::optional<FolderInUse>(int)> work;
  /// Called for each thing that another process holds, several times a second and by several threads:
  /// whether to try again.
  std::function<bool(int, const FolderInUse&)> waits;
};

/// Works on things 0, ..., n - 1, each once, on `n_threads` threads. Things that other processes hold are
/// attempted again when the rest is done. Throws OutputError.
void share_work(int n_threads, int n, const SharedWork& shared);

}  // namespace wheelwright
