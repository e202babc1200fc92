#pragma once

#include <string>
#include <thread>

namespace wheelwright {

/// Says on standard error what the program does, if it still does it after some time.
class SlowStage {
 public:
  explicit SlowStage(std::string what, double seconds = 1.5);

 private:
  std::jthread timer_;
};

}  // namespace wheelwright
