#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// The file in a run's folder with the commands that it executed, one per line.
inline constexpr const char* command_log_file = "commands.jsonl";

/// When a run executed a command: after how many of its own trials, not those of commands, and after how many
/// waits for commands. A run of the same case with the same commands at the same moments produces the same
/// shapes.
struct Moment {
  int trials = 0, waits = 0;
  auto operator<=>(const Moment&) const = default;
};

struct LoggedCommand {
  Moment moment;
  Command command;
};

/// Determines the moments of a run from its events.
class MomentCounter {
 public:
  template <int dim>
  void count(const Event<dim>& event) {
    if (std::holds_alternative<CaseChanged>(event) || std::holds_alternative<ShapeReplaced>(event))
      is_of_command_ = true;
    if (std::holds_alternative<TrialDone<dim>>(event) && !std::exchange(is_of_command_, false)) ++now_.trials;
    if (std::holds_alternative<RunWaits>(event)) ++now_.waits;
  }
  const Moment& now() const { return now_; }

 private:
  Moment now_;
  bool is_of_command_ = false;  ///< the next trial
};

std::string log_line(const LoggedCommand& logged);

/// The commands of a log, or what is wrong with it. An incomplete last line, as after a kill, is ignored.
Expected<std::vector<LoggedCommand>, Refusal> parse_command_log(
    std::string_view text, const CommandKinds& kinds = commands_of_every_run());

/// Writes the log: each executed command is flushed before the next one.
template <int dim>
class CommandLog : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  MomentCounter moments_;
};

/// Replays the commands of a log at their moments, then Stop when all are executed and the run waits. It
/// counts moments as an observer; its source of commands must be added to the run's queue.
template <int dim>
class CommandReplay : public Observer<dim> {
 public:
  explicit CommandReplay(std::vector<LoggedCommand> log);

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
  CommandQueue::Source source() const;

 private:
  struct Progress {
    std::vector<LoggedCommand> log;
    std::size_t given = 0;
    MomentCounter moments = {};
    bool is_waiting = false, is_stopped = false;
  };
  std::shared_ptr<Progress> progress_;
};

}  // namespace wheelwright
