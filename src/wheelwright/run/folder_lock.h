#pragma once

#include <filesystem>
#include <optional>

namespace wheelwright {

/// The right of one process to write to a folder. It ends with this object or with the process, however that
/// ends, so that no dead process blocks a folder.
class FolderLock {
 public:
  /// Creates the folder, if it does not exist, and the file run.lock in it. Locks both: somebody may remove
  /// the file, and on some file systems of networks a folder cannot be locked. Empty if another process holds
  /// either lock. Throws OutputError.
  static std::optional<FolderLock> acquire(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  FolderLock() = default;

  int folder_ = -1, file_ = -1;  ///< descriptors; -1 when moved from
};

}  // namespace wheelwright
