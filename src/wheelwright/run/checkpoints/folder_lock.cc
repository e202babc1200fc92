#include "wheelwright/run/checkpoints/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <utility>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/files/written_files.h"

namespace wheelwright {

namespace {

/// 0, or the errno.
int lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno; }

/// The holder of a lock, as written to its file.
FolderInUse holder(const std::filesystem::path& path) {
  std::ifstream file(path);
  long process = 0;
  if (file >> process && process > 0) return {process};
  return {};
}

/// Writes the id of this process to the file. Errors are ignored: the lock holds regardless.
void sign(int file) {
  const std::string text = fmt::format("{}\n", ::getpid());
  if (::ftruncate(file, 0) == 0 && ::pwrite(file, text.data(), text.size(), 0) < 0) return;
}

}  // namespace

std::string to_string(const FolderInUse& in_use) {
  return in_use.process ? fmt::format("process {}", *in_use.process) : "another process";
}

Expected<FolderLock, FolderInUse> FolderLock::acquire(const std::filesystem::path& folder) {
  make_folder(folder);
  const auto path = folder / lock_file;
  claim_file(path);
  FolderLock held;
  held.folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (held.folder_ < 0) throw OutputError(folder, errno);
  if (lock(held.folder_) == EWOULDBLOCK) return holder(path);
  held.file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (held.file_ < 0) throw OutputError(path, errno);
  const int error = lock(held.file_);
  if (error == EWOULDBLOCK) return holder(path);
  if (error != 0) throw OutputError(path, error);
  sign(held.file_);
  return held;
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::exchange(other.folder_, -1)), file_(std::exchange(other.file_, -1)) {}

FolderLock::~FolderLock() {
  for (const int held : {file_, folder_})
    if (held >= 0) ::close(held);
}

}  // namespace wheelwright
