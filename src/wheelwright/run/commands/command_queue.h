#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "wheelwright/run/commands/commands.h"

namespace wheelwright {

/// Pending commands to a run. Any thread may push them; the run takes them between its trial shapes, in
/// order.
class CommandQueue {
 public:
  /// A source that is polled for commands: at least before every trial shape, and several times a second
  /// while a shape is evaluated or the run is paused.
  using Source = std::function<std::optional<Command>()>;

  void push(Command command);
  /// The source is polled at the next call of any of the functions below. It must not access the queue.
  void add_source(Source source);

  /// The next command, if there is one.
  std::optional<Command> take();

  /// The next command; blocks until there is one.
  Command wait();

  /// The number of waiting commands to stop. To be called often while a shape is evaluated.
  int waiting_stops();

 private:
  using Clock = std::chrono::steady_clock;
  void ask_sources();

  std::mutex mutex_;
  std::condition_variable pushed_;
  std::deque<Command> commands_;
  std::vector<Source> sources_;
  Clock::time_point ask_again_ =
      Clock::time_point::min();  ///< from when waiting_stops() polls the sources again
};

}  // namespace wheelwright
