#pragma once

#include <chrono>

namespace wheelwright {

/// Measures wall time since construction or the last lap.
class Stopwatch {
 public:
  /// Seconds since the start of the current lap, which continues.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  /// Seconds since the start of the current lap; starts the next lap.
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
