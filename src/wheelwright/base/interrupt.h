#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "wheelwright/base/expected.h"

namespace wheelwright {

/// Tells how far the contact problems of a shape are.
struct ContactProgress {
  int position, n_positions;  ///< the load position that is being solved, from 0
  int newton_steps;           ///< taken at this position so far
  int load = 0, n_loads = 1;  ///< which of several loads is being solved at this position, from 0
};

/// Polled by long computations: whether to end early, with the failure `interrupted`. Polling is cheap; once
/// requested, an interrupt stays requested. The caller also reports the progress of the contact.
class Interrupt {
 public:
  using Progress = std::function<void(const ContactProgress&)>;

  /// Never requested.
  Interrupt() = default;
  explicit Interrupt(std::function<bool()> requested, Progress progress = {})
      : requested_(std::move(requested)), progress_(std::move(progress)) {}

  bool requested() const { return requested_ && requested_(); }

  /// Called between the phases of a computation; `next` is the one that follows (base/phase_time.h).
  std::optional<Failure> before(const char* next) const {
    if (!requested()) return {};
    return Failure{FailureReason::interrupted, std::string("before the phase ") + next};
  }

  /// Called before every step of a contact problem.
  void report(const ContactProgress& progress) const {
    if (progress_) progress_(progress);
  }

  /// The same for one of several load positions: progress is reported for that position.
  Interrupt at_position(int position, int n_positions) const {
    return with([position, n_positions](ContactProgress& progress) {
      progress.position = position;
      progress.n_positions = n_positions;
    });
  }

  /// The same for one of several loads at a position.
  Interrupt at_load(int load, int n_loads) const {
    return with([load, n_loads](ContactProgress& progress) {
      progress.load = load;
      progress.n_loads = n_loads;
    });
  }

  /// The same after other steps at the position.
  Interrupt after_steps(int steps) const {
    return with([steps](ContactProgress& progress) { progress.newton_steps += steps; });
  }

 private:
  /// Completes what is reported.
  template <class Complete>
  Interrupt with(Complete complete) const {
    if (!progress_) return *this;
    return Interrupt(requested_, [report = progress_, complete](ContactProgress progress) {
      complete(progress);
      report(progress);
    });
  }

  std::function<bool()> requested_;
  Progress progress_;
};

}  // namespace wheelwright
