#pragma once

#include <filesystem>
#include <optional>

namespace wheelwright {

/// The right of one process to write to a folder. It ends with this object or with the process, however that
/// ends, so that no dead process blocks a folder.
class FolderLock {
 public:
  /// Creates the folder, if it does not exist, and the file run.lock in it. Empty if another process holds
  /// the lock. Throws OutputError.
  static std::optional<FolderLock> acquire(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int file) : file_(file) {}

  int file_;  ///< descriptor; -1 when moved from
};

}  // namespace wheelwright
