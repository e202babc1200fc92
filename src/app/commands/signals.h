#pragma once

#include <csignal>
#include <map>
#include <optional>

namespace wheelwright {

/// While one lives, SIGINT and SIGTERM no longer end the program: the first is noted, the second ends it at
/// once. SIGUSR1 asks for a checkpoint. A write beyond a limit on file sizes fails like any other instead of
/// ending the program by SIGXFSZ. Signals that were ignored stay so. One at a time.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// SIGINT or SIGTERM, when one came.
  std::optional<int> stop() const;

  /// Whether SIGUSR1 came since the last call.
  bool take_save_request();

 private:
  std::map<int, struct sigaction> before_;
};

}  // namespace wheelwright
