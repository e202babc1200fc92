#pragma once

#include <functional>
#include <utility>

namespace wheelwright {

/// What a long computation asks from time to time: whether it should end early, with the failure
/// `interrupted`. The question is cheap; once the answer was yes it stays yes.
class Interrupt {
 public:
  /// Never requested.
  Interrupt() = default;
  explicit Interrupt(std::function<bool()> requested) : requested_(std::move(requested)) {}

  bool requested() const { return requested_ && requested_(); }

 private:
  std::function<bool()> requested_;
};

}  // namespace wheelwright
