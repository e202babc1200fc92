#pragma once

#include <chrono>

namespace wheelwright {

/// Wall time since construction or the last lap.
class Stopwatch {
 public:
  /// Seconds since the last lap, which goes on.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Seconds since the last lap; begins the next.
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace wheelwright
