#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// The commands from pages to a run, each with a ticket to retrieve its answer.
class PageCommands {
 public:
  struct Answer {
    long ticket;
    bool was_executed;
    std::string text;
  };

  explicit PageCommands(CommandQueue& queue) : queue_(queue) {}

  /// Whether pages may give such a command: not Save and Stop.
  static bool is_for_pages(const Command& command);

  /// Empty while too many are waiting.
  std::optional<long> give(Command command);

  /// The answer to a ticket; empty if it does not arrive in time or nobody waits any longer.
  std::optional<Answer> answer(long ticket, std::chrono::milliseconds patience);

  /// To be called for every command that was executed or refused.
  void note(const CommandDone& done);

  void close();

 private:
  CommandQueue& queue_;
  std::mutex mutex_;
  std::condition_variable answered_;
  std::deque<Command> waiting_;  ///< given and not executed yet
  long given_ = 0, done_ = 0;
  std::deque<Answer> answers_;  ///< the last ones
  bool is_closed_ = false;
};

/// Passes the results of commands on to PageCommands.
template <int dim>
class PageCommandsObserver : public Observer<dim> {
 public:
  explicit PageCommandsObserver(std::shared_ptr<PageCommands> commands) : commands_(std::move(commands)) {}

  void operator()(const Event<dim>& event, const RunView<dim>&) override {
    if (const auto* done = std::get_if<CommandDone>(&event)) commands_->note(*done);
  }

 private:
  std::shared_ptr<PageCommands> commands_;
};

}  // namespace wheelwright
