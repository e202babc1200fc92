#include "wheelwright/web/watch/page_commands.h"

#include <algorithm>

namespace wheelwright {

bool PageCommands::is_for_pages(const Command& command) { return !command.is<Save>() && !command.is<Stop>(); }

std::optional<long> PageCommands::give(Command command) {
  constexpr long max_waiting = 32;
  const std::scoped_lock lock(mutex_);
  if (given_ - done_ >= max_waiting) return {};
  waiting_.push_back(command);
  queue_.push(std::move(command));
  return ++given_;
}

std::optional<PageCommands::Answer> PageCommands::answer(long ticket, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  answered_.wait_for(lock, patience, [&] { return is_closed_ || done_ >= ticket; });
  const auto found = std::ranges::find(answers_, ticket, &Answer::ticket);
  if (found == answers_.end()) return {};
  return *found;
}

void PageCommands::note(const CommandDone& done) {
  constexpr std::size_t max_answers = 256;
  {
    const std::scoped_lock lock(mutex_);
    if (waiting_.empty() || !waiting_.front().is_copy_of(done.command)) return;  // from elsewhere
    waiting_.pop_front();
    answers_.push_back({++done_, done.was_executed, done.text});
    if (answers_.size() > max_answers) answers_.pop_front();
  }
  answered_.notify_all();
}

void PageCommands::close() {
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
  }
  answered_.notify_all();
}

}  // namespace wheelwright
