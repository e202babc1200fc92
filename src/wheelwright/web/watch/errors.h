#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/web/watch/board.h"
#include "wheelwright/web/watch/products.h"

namespace wheelwright {

/// Estimates the discretization errors of a shape when a page requests it: solves the shape on the next finer
/// grid (run/results/finer_wheel.h) in a thread of its own, one shape at a time. The run does not wait.
/// Thread-safe.
template <int dim>
class WatchedErrors {
 public:
  /// Begins with the newest shape of a view, which must have one. Returns what is being done, for display;
  /// refuses while another estimate is in progress.
  Expected<std::string, NoProduct> begin(const BoardView<dim>& view);

  /// As JSON: `busy`, the shape that is being solved and the seconds so far, or null; `estimate`, the last
  /// one, or null: the numbers of its shape with their errors as in summary.json, how to display them, the
  /// shape's version on the board, and the seconds that it took; `failure` if it failed unexpectedly. Waits
  /// for an estimate in progress, but not longer than this.
  std::string json(std::chrono::milliseconds patience);

  /// Ends the estimate in progress. None begins afterwards.
  void close();

 private:
  struct Busy {
    int shape;
    Stopwatch since;
  };
  void finish(std::string estimate);

  std::mutex mutex_;
  std::condition_variable ended_;
  std::optional<Busy> busy_;
  std::string estimate_ = "null";  ///< the last one, as JSON
  bool is_closed_ = false;
  std::jthread worker_;  ///< the last member: it uses the others until it is joined
};

}  // namespace wheelwright
