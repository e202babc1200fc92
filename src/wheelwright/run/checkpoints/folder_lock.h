#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// The file in a locked folder.
inline constexpr const char* lock_file = "run.lock";

/// Another process writes to the folder.
struct FolderInUse {
  std::optional<long> process = {};  ///< its id, if it could be read
};

/// "process 1234", or "another process".
std::string to_string(const FolderInUse& in_use);

/// The exclusive right of a process to write to a folder. It ends with this object or with the process,
/// however that ends, so that a dead process never blocks a folder.
class FolderLock {
 public:
  /// Creates the folder, if it does not exist, and the file run.lock in it. Locks both: somebody may remove
  /// the file, and some network file systems cannot lock folders. The file contains the id of this process.
  /// Fails if another process holds either lock. Throws OutputError.
  static Expected<FolderLock, FolderInUse> acquire(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  FolderLock() = default;

  int folder_ = -1, file_ = -1;  ///< descriptors; -1 when moved from
};

}  // namespace wheelwright
