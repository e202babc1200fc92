#pragma once

#include <filesystem>
#include <optional>

#include "wheelwright/run/commands/commands.h"

namespace wheelwright {

inline constexpr const char* stop_file = "STOP";

/// The file STOP in a run's folder, with which anyone who can write there stops the run. Folders and links of
/// that name do not count.
class StopFile {
 public:
  explicit StopFile(const std::filesystem::path& folder) : file_(folder / stop_file) {}

  /// A source of commands: one Stop when the file is there.
  std::optional<Command> operator()() {
    if (was_seen_ || !exists()) return {};
    was_seen_ = true;
    return Stop{};
  }

  bool exists() const {
    std::error_code ignored;
    return std::filesystem::symlink_status(file_, ignored).type() == std::filesystem::file_type::regular;
  }

  void remove() const {
    std::error_code ignored;
    if (exists()) std::filesystem::remove(file_, ignored);
  }

 private:
  std::filesystem::path file_;
  bool was_seen_ = false;
};

}  // namespace wheelwright
