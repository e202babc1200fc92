#pragma once

#include <filesystem>
#include <optional>

#include "wheelwright/run/command.h"

namespace wheelwright {

/// The file STOP in a run's folder, by which anyone who can write there stops the run.
class StopFile {
 public:
  explicit StopFile(const std::filesystem::path& folder) : file_(folder / "STOP") {}

  /// A source of commands: one Stop when the file is there.
  std::optional<Command> operator()() {
    std::error_code ignored;
    if (was_seen_ || !std::filesystem::exists(file_, ignored)) return {};
    was_seen_ = true;
    return Stop{};
  }

  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }

 private:
  std::filesystem::path file_;
  bool was_seen_ = false;
};

}  // namespace wheelwright
