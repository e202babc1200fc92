#include "wheelwright/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "wheelwright/files/output_error.h"
#include "wheelwright/files/written_files.h"

namespace wheelwright {
namespace {

int synchronize(int file) { return ::fsync(file) == 0 || errno == EINVAL ? 0 : errno; }

/// Makes renamed or new entries of the folder durable; returns 0 or the errno of the call that failed.
int synchronize_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = synchronize(file);
  ::close(file);
  return error;
}

/// Writes everything; returns 0 or the errno of the call that failed.
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(written);
  }
  return 0;
}

/// Writes everything and synchronizes; returns 0 or the errno of the call that failed.
int write_and_sync(int file, std::span<const std::string_view> parts) {
  for (const std::string_view part : parts)
    if (const int error = write_all(file, part); error != 0) return error;
  return synchronize(file);
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  write_atomically(path, std::span(&content, 1));
}

void write_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts) {
  claim_file(path);
  const std::filesystem::path temporary = path.string() + ".tmp";
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) throw OutputError(path, errno);
  int error = write_and_sync(file, parts);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) error = synchronize_folder(path.parent_path());
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw OutputError(path, error);
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const bool is_new = std::filesystem::create_directories(folder, error);
  const int failed = error ? error.value() : is_new ? synchronize_folder(folder.parent_path()) : 0;
  if (failed != 0) throw OutputError(folder, failed);
  WrittenFiles(folder).begin();
}

void make_subfolder(const std::filesystem::path& folder) {
  claim_folder(folder);
  make_folder(folder);
}

}  // namespace wheelwright
