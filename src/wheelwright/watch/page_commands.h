#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "wheelwright/run/command_queue.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

/// The commands that pages give a run, each with a ticket by which its answer is found.
class PageCommands {
 public:
  struct Answer {
    long ticket;
    bool was_obeyed;
    std::string text;
  };

  explicit PageCommands(CommandQueue& queue) : queue_(queue) {}

  /// Whether commands like this come from pages. To save, to stop, and what a program gives, come from
  /// elsewhere.
  static bool is_for_pages(const Command& command);

  /// Empty while too many are waiting.
  std::optional<long> give(Command command);

  /// The answer to a ticket; empty when it does not come in time or nobody asks any longer.
  std::optional<Answer> answer(long ticket, std::chrono::milliseconds patience);

  /// To be told of every command that was obeyed or refused.
  void note(const CommandDone& done);

  void close();

 private:
  CommandQueue& queue_;
  std::mutex mutex_;
  std::condition_variable answered_;
  long given_ = 0, done_ = 0;
  std::deque<Answer> answers_;  ///< the last ones
  bool is_closed_ = false;
};

/// Tells them what became of the commands.
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
