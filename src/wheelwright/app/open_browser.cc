#include "wheelwright/app/open_browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "wheelwright/files/path_queries.h"

namespace wheelwright {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value != '\0';
}

}  // namespace

AddressFile::AddressFile(const std::string& address) {
  const char* of_user = std::getenv("XDG_RUNTIME_DIR");
  const std::filesystem::path base =
      of_user && is_folder(of_user) ? std::filesystem::path(of_user) : std::filesystem::temp_directory_path();
  std::string name = (base / "wheelwright-XXXXXX").string();
  if (!::mkdtemp(name.data())) fail(name);  // with mode 700
  folder_ = name;
  file_ = folder_ / "open.html";
  const std::string page = fmt::format(
      "<!DOCTYPE html><meta charset=\"utf-8\"><title>wheelwright</title>"
      "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">Open the wheel</a>\n",
      address);
  const int descriptor = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (descriptor < 0) fail(file_);
  const ssize_t written = ::write(descriptor, page.data(), page.size());
  ::close(descriptor);
  if (written != static_cast<ssize_t>(page.size())) fail(file_);
}

AddressFile::~AddressFile() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  std::filesystem::remove(folder_, ignored);
}

bool open_browser(const std::filesystem::path& file) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return false;
  std::string command = "xdg-open", argument = file.string();
  char* arguments[] = {command.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  ::posix_spawn_file_actions_init(&quiet);
  ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, command.c_str(), &quiet, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return false;
  int status = 0;
  ::waitpid(child, &status, 0);  // xdg-open returns when the browser has the file
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace wheelwright
