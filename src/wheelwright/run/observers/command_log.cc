#include "wheelwright/run/observers/command_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/run/commands/command_json.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

std::optional<int> count_in(const Json& json, const char* key) {
  if (!json.contains(key) || !json[key].is_number_unsigned() || json[key] > 1'000'000'000) return {};
  return json[key].get<int>();
}

Expected<LoggedCommand, Refusal> parse_line(const std::string& line, const CommandKinds& kinds) {
  constexpr int levels = 5;
  if (is_nested_deeper(line, levels)) return Refusal{"no logged command"};
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("command")) return Refusal{"no logged command"};
  const auto trials = count_in(json, "trials"), waits = count_in(json, "waits");
  if (!trials || !waits) return Refusal{"its moment is missing"};
  const auto command = parse_command(json["command"].dump(), kinds);
  if (!command) return command.failure();
  return LoggedCommand{{*trials, *waits}, *command};
}

}  // namespace

std::string log_line(const LoggedCommand& logged) {
  return fmt::format("{{\"trials\":{},\"waits\":{},\"command\":{}}}\n", logged.moment.trials,
                     logged.moment.waits, command_json(logged.command));
}

Expected<std::vector<LoggedCommand>, Refusal> parse_command_log(std::string_view text,
                                                                const CommandKinds& kinds) {
  std::vector<LoggedCommand> log;
  int number = 0;
  while (true) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return log;
    ++number;
    auto logged = parse_line(std::string(text.substr(0, end)), kinds);
    if (!logged) return Refusal{fmt::format("line {}: {}", number, logged.failure().reason)};
    if (!log.empty() && logged->moment < log.back().moment)
      return Refusal{fmt::format("line {}: is earlier than the line above it", number)};
    log.push_back(*std::move(logged));
    text.remove_prefix(end + 1);
  }
}

template <int dim>
void CommandLog<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto path = run.folder / command_log_file;
  if (const auto* started = std::get_if<RunStarted>(&event); started && !started->resumed_after)
    write_atomically(path, "");
  if (const auto* done = std::get_if<CommandDone>(&event); done && done->was_executed) {
    std::ofstream stream(path, std::ios::app | std::ios::binary);
    if (!(stream << log_line({moments_.now(), done->command})).flush()) throw OutputError(path, errno);
  }
  moments_.count<dim>(event);
}

template <int dim>
CommandReplay<dim>::CommandReplay(std::vector<LoggedCommand> log)
    : progress_(std::make_shared<Progress>(Progress{.log = std::move(log)})) {}

template <int dim>
void CommandReplay<dim>::operator()(const Event<dim>& event, const RunView<dim>&) {
  progress_->moments.template count<dim>(event);
  if (std::holds_alternative<RunWaits>(event)) progress_->is_waiting = true;
  if (std::holds_alternative<RunProceeds>(event)) progress_->is_waiting = false;
}

template <int dim>
CommandQueue::Source CommandReplay<dim>::source() const {
  return [progress = progress_]() -> std::optional<Command> {
    auto& [log, given, moments, is_waiting, is_stopped] = *progress;
    if (given < log.size() && log[given].moment <= moments.now()) {
      const Command next = log[given++].command;
      is_stopped = is_stopped || next.is<Stop>();
      return next;
    }
    if (given < log.size() || !is_waiting || is_stopped) return {};
    is_stopped = true;
    return Stop{};
  };
}

template class CommandLog<2>;
template class CommandLog<3>;
template class CommandReplay<2>;
template class CommandReplay<3>;

}  // namespace wheelwright
