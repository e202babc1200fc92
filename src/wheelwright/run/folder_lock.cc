#include "wheelwright/run/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/files/written_files.h"

namespace wheelwright {

namespace {

/// 0, or the errno.
int lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno; }

}  // namespace

std::optional<FolderLock> FolderLock::acquire(const std::filesystem::path& folder) {
  make_folder(folder);
  const auto path = folder / "run.lock";
  claim_file(path);
  FolderLock held;
  held.folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (held.folder_ < 0) throw OutputError(folder, errno);
  if (lock(held.folder_) == EWOULDBLOCK) return {};
  held.file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (held.file_ < 0) throw OutputError(path, errno);
  const int error = lock(held.file_);
  if (error == EWOULDBLOCK) return {};
  if (error != 0) throw OutputError(path, error);
  return held;
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::exchange(other.folder_, -1)), file_(std::exchange(other.file_, -1)) {}

FolderLock::~FolderLock() {
  for (const int held : {file_, folder_})
    if (held >= 0) ::close(held);
}

}  // namespace wheelwright
