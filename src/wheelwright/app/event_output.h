#pragma once

#include <optional>
#include <string>

#include "wheelwright/run/observers/event_lines.h"

namespace wheelwright {

/// Lines of JSON on standard output, for a program that drives a run (--events json). Each is flushed, so
/// that it can be read at once.
class EventOutput {
 public:
  void write(const std::string& line) const;

  /// Why the run ended.
  void set_reason(StopReason reason) { reason_ = reason; }

  /// The last line. Returns the code.
  int end(int exit_code) const;

 private:
  std::optional<StopReason> reason_;
};

}  // namespace wheelwright
