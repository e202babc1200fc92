#pragma once

#include <csignal>
#include <map>
#include <optional>

#include "wheelwright/run/commands/commands.h"

namespace wheelwright {

/// While an instance exists, SIGINT, SIGTERM and SIGHUP no longer terminate the program but are recorded. A
/// second SIGINT or SIGTERM terminates it at once; a second SIGHUP does not, because both the kernel and a
/// shell send it when a terminal is closed. SIGUSR1 requests a checkpoint. A write beyond a limit on file
/// sizes fails like any other instead of raising SIGXFSZ. Ignored signals stay ignored. Only one instance may
/// exist.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// SIGINT, SIGTERM or SIGHUP, if one arrived.
  std::optional<int> stop() const;

  /// A source of commands for a run: Stop, once, and Save.
  std::optional<Command> next_command();

 private:
  bool stop_is_passed_on_ = false;
  std::map<int, struct sigaction> before_;
};

}  // namespace wheelwright
