#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// The file in a locked folder.
inline constexpr const char* lock_file = "run.lock";

/// Another process writes to the folder.
struct FolderInUse {
  std::optional<long> process = {};  ///< its id, if it could be read
  std::string machine = {};          ///< the name of its machine, if it is another one
};

/// "process 1234", "process 1234 on node7", or "another process".
std::string to_string(const FolderInUse& in_use);

/// The exclusive right of a process to what a file stands for. It ends with this object or with the process,
/// however that ends.
class FileLock {
 public:
  /// Creates the file, if it does not exist, and writes the id of this process and the name of its machine to
  /// it. Fails if another process, or another object of this one, holds the lock. Throws OutputError.
  static Expected<FileLock, FolderInUse> acquire(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int file) : file_(file) {}

  int file_;  ///< descriptor; -1 when moved from
};

/// The exclusive right of a process to write to a folder. It ends with this object or with the process,
/// however that ends, so that a dead process never blocks a folder.
class FolderLock {
 public:
  /// Creates the folder, if it does not exist, and the file run.lock in it. Locks both: somebody may remove
  /// the file, and some network file systems cannot lock folders. Fails if another process holds either lock.
  /// Throws OutputError.
  static Expected<FolderLock, FolderInUse> acquire(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  FolderLock(int folder, FileLock file) : folder_(folder), file_(std::move(file)) {}

  int folder_;  ///< descriptor; -1 when moved from
  FileLock file_;
};

}  // namespace wheelwright
