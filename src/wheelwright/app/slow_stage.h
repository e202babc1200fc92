#pragma once

#include <string>
#include <thread>

namespace wheelwright {

/// Prints on standard error what the program is doing, if that takes longer than some time.
class SlowStage {
 public:
  explicit SlowStage(std::string what, double seconds = 1.5);

 private:
  std::jthread timer_;
};

}  // namespace wheelwright
