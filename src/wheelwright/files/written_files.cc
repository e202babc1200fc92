#include "wheelwright/files/written_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <utility>

#include "wheelwright/files/output_error.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line =
    "# wheelwright wrote these files, and may replace or remove them, but no others";
constexpr std::string_view temporary_ending = ".tmp";

/// Does not follow symbolic links.
fs::file_type type_of(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}

/// False if the name cannot be used at all, e.g. below a link to itself: writing fails there.
bool stands(const fs::path& path) {
  return type_of(path) != fs::file_type::not_found && type_of(path) != fs::file_type::none;
}

/// Makes a new file that has its content from its beginning on, even if the process is killed. False if it
/// stands already, or cannot be made in this way on its file system.
bool create_whole(const fs::path& path, std::string_view text) {
  const int file = ::open(path.parent_path().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) return false;
  const bool is_written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                          (::fsync(file) == 0 || errno == EINVAL);
  const std::string unnamed = fmt::format("/proc/self/fd/{}", file);
  const bool is_named =
      is_written && ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
  ::close(file);
  return is_named;
}

/// Names of folders end in a slash in the list.
std::string listed_as(std::string_view name, fs::file_type type) {
  return std::string(name) + (type == fs::file_type::directory ? "/" : "");
}

}  // namespace

WrittenFiles::WrittenFiles(fs::path folder)
    : folder_(folder.empty() ? "." : std::move(folder)), exists_(false) {
  const fs::path list = folder_ / list_of_written_files;
  if (type_of(list) != fs::file_type::regular) return;
  std::ifstream file(list);
  std::string line;
  exists_ = std::getline(file, line) && line == first_line;
  while (exists_ && std::getline(file, line)) {
    names_.insert(line);
    ends_with_newline_ = !file.eof();
  }
}

bool WrittenFiles::is_own(std::string_view name) const {
  const fs::file_type type = type_of(folder_ / name);
  if (type != fs::file_type::regular && type != fs::file_type::directory) return false;
  if (names_.contains(listed_as(name, type))) return true;
  return type == fs::file_type::regular && name.ends_with(temporary_ending) &&
         names_.contains(name.substr(0, name.size() - temporary_ending.size()));
}

std::vector<std::string> WrittenFiles::standing(std::span<const std::string_view> names) const {
  std::vector<std::string> found;
  if (!exists_ && stands(folder_ / list_of_written_files)) found.emplace_back(list_of_written_files);
  for (const std::string_view name : names)
    for (const std::string& candidate : {std::string(name), fmt::format("{}{}", name, temporary_ending)})
      if (stands(folder_ / candidate)) found.push_back(candidate);
  return found;
}

std::vector<std::string> WrittenFiles::foreign(std::span<const std::string_view> names) const {
  auto found = standing(names);
  std::erase_if(found, [&](const std::string& name) { return is_own(name); });
  return found;
}

void WrittenFiles::begin() {
  if (exists_) return;
  append(first_line);
  exists_ = true;
}

void WrittenFiles::claim(std::string_view name, const std::string& line) {
  if (!exists_) return;
  auto others = foreign(std::span(&name, 1));
  const fs::file_type type = type_of(folder_ / name);
  if (stands(folder_ / name) && listed_as(name, type) != line) others.emplace_back(name);
  if (!others.empty())
    throw OutputError(
        folder_ / others.front(),
        fmt::format(
            "wheelwright did not write it and will not replace it; move it away, or add its name to {}",
            (folder_ / list_of_written_files).string()));
  list(line);
}

void WrittenFiles::list(const std::string& line) {
  if (!names_.insert(line).second) return;
  append(line);
}

/// First terminates a line that an interrupted write left incomplete: half a name lists nothing.
void WrittenFiles::append(std::string_view line) const {
  const fs::path list = folder_ / list_of_written_files;
  const std::string text = fmt::format("{}{}\n", ends_with_newline_ ? "" : "\n", line);
  if (!exists_ && create_whole(list, text)) return;
  const int flags = O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC | (exists_ ? 0 : O_CREAT | O_EXCL);
  const int file = ::open(list.c_str(), flags, 0666);
  if (file < 0) throw OutputError(list, errno);
  const ssize_t written = ::write(file, text.data(), text.size());
  int error = written < 0 ? errno : written < static_cast<ssize_t>(text.size()) ? ENOSPC : 0;
  if (error == 0 && ::fsync(file) != 0 && errno != EINVAL) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0) return;
  if (!exists_) ::unlink(list.c_str());  // half a first line is no list
  throw OutputError(list, error);
}

void claim_file(const fs::path& path) {
  WrittenFiles(path.parent_path()).claim_file(path.filename().string());
}

void claim_folder(const fs::path& path) {
  WrittenFiles(path.parent_path()).claim_folder(path.filename().string());
}

}  // namespace wheelwright
