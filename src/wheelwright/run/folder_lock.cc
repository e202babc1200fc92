#include "wheelwright/run/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"

namespace wheelwright {

std::optional<FolderLock> FolderLock::acquire(const std::filesystem::path& folder) {
  make_folder(folder);
  const auto path = folder / "run.lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw OutputError(path, errno);
  FolderLock lock(file);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno == EWOULDBLOCK) return {};
  throw OutputError(path, errno);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace wheelwright
