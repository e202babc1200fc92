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

std::string name_of_this_machine() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

/// The holder of a lock, as written to its file.
FolderInUse holder(const std::filesystem::path& path) {
  std::ifstream file(path);
  FolderInUse in_use;
  long process = 0;
  if (!(file >> process) || process <= 0) return in_use;
  in_use.process = process;
  file >> in_use.machine;
  if (in_use.machine == name_of_this_machine()) in_use.machine.clear();
  return in_use;
}

/// Writes the id of this process to the file. Errors are ignored: the lock holds regardless.
void sign(int file) {
  const std::string text = fmt::format("{} {}\n", ::getpid(), name_of_this_machine());
  if (::ftruncate(file, 0) == 0 && ::pwrite(file, text.data(), text.size(), 0) < 0) return;
}

void close_if_open(int file) {
  if (file >= 0) ::close(file);
}

/// Closes a descriptor at the end of its scope, unless it was taken.
struct FolderGuard {
  int descriptor;
  ~FolderGuard() { close_if_open(descriptor); }
};

}  // namespace

std::string to_string(const FolderInUse& in_use) {
  if (!in_use.process) return "another process";
  return fmt::format("process {}{}{}", *in_use.process, in_use.machine.empty() ? "" : " on ", in_use.machine);
}

Expected<FileLock, FolderInUse> FileLock::acquire(const std::filesystem::path& path) {
  claim_file(path);
  FileLock held(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (held.file_ < 0) throw OutputError(path, errno);
  const int error = lock(held.file_);
  if (error == EWOULDBLOCK) return holder(path);
  if (error != 0) throw OutputError(path, error);
  sign(held.file_);
  return held;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock::~FileLock() { close_if_open(file_); }

Expected<FolderLock, FolderInUse> FolderLock::acquire(const std::filesystem::path& folder) {
  make_folder(folder);
  const auto path = folder / lock_file;
  claim_file(path);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw OutputError(folder, errno);
  FolderGuard guard{descriptor};
  if (lock(descriptor) == EWOULDBLOCK) return holder(path);
  auto file = FileLock::acquire(path);
  if (!file) return file.failure();
  return FolderLock(std::exchange(guard.descriptor, -1), *std::move(file));
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::exchange(other.folder_, -1)), file_(std::move(other.file_)) {}

FolderLock::~FolderLock() { close_if_open(folder_); }

}  // namespace wheelwright
