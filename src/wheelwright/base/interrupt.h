#pragma once

#include <functional>
#include <utility>

namespace wheelwright {

/// Asks a long computation to end early. The computation polls it between its steps and then fails with
/// FailureReason::interrupted; without a question it never asks.
class Interrupt {
 public:
  Interrupt() = default;
  explicit Interrupt(std::function<bool()> asks) : asks_(std::move(asks)) {}

  bool operator()() const { return asks_ && asks_(); }

 private:
  std::function<bool()> asks_;
};

}  // namespace wheelwright
