#include "wheelwright/run/commands/command_queue.h"

#include <algorithm>
#include <utility>

namespace wheelwright {
namespace {

constexpr std::chrono::milliseconds between_questions{100};

}  // namespace

void CommandQueue::push(Command command) {
  {
    const std::scoped_lock lock(mutex_);
    commands_.push_back(std::move(command));
  }
  pushed_.notify_one();
}

void CommandQueue::add_source(Source source) {
  const std::scoped_lock lock(mutex_);
  sources_.push_back(std::move(source));
  ask_again_ = Clock::time_point::min();
}

void CommandQueue::ask_sources() {
  ask_again_ = Clock::now() + between_questions;
  for (const Source& source : sources_)
    while (auto command = source()) commands_.push_back(*std::move(command));
}

std::optional<Command> CommandQueue::take() {
  const std::scoped_lock lock(mutex_);
  ask_sources();
  if (commands_.empty()) return {};
  Command command = std::move(commands_.front());
  commands_.pop_front();
  return command;
}

Command CommandQueue::wait() {
  while (true) {
    if (auto command = take()) return *std::move(command);
    std::unique_lock lock(mutex_);
    pushed_.wait_for(lock, between_questions, [&] { return !commands_.empty(); });
  }
}

int CommandQueue::waiting_stops() {
  const std::scoped_lock lock(mutex_);
  if (Clock::now() >= ask_again_) ask_sources();
  return static_cast<int>(
      std::ranges::count_if(commands_, [](const Command& command) { return command.is<Stop>(); }));
}

}  // namespace wheelwright
