#pragma once

#include <csignal>
#include <map>
#include <optional>

#include "wheelwright/run/command.h"

namespace wheelwright {

/// While one lives, SIGINT, SIGTERM and SIGHUP no longer end the program: they are noted. A second one of
/// SIGINT and SIGTERM ends it at once; SIGHUP never does, for the kernel and a shell both send it when a
/// terminal is closed. SIGUSR1 asks for a checkpoint. A write beyond a limit on file sizes fails like any
/// other instead of ending the program by SIGXFSZ. Signals that were ignored stay so. One at a time.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// SIGINT, SIGTERM or SIGHUP, when one came.
  std::optional<int> stop() const;

  /// A source of commands for a run: Stop, once, and Save.
  std::optional<Command> next_command();

 private:
  bool stop_is_passed_on_ = false;
  std::map<int, struct sigaction> before_;
};

}  // namespace wheelwright
