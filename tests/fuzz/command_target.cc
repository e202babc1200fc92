#include "tests/fuzz/target.h"
#include "wheelwright/run/command_json.h"
#include "wheelwright/run/command_log.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

/// What a page sends.
void try_command(std::string_view text) {
  const auto command = parse_command(text);
  if (!command) return require(!command.failure().reason.empty(), "a refusal has a reason");
  const std::string written = command_json(*command);
  require(written.find('\n') == std::string::npos, "a command is one line");
  const auto again = parse_command(written);
  require(again && command_json(*again) == written, "what is written is read as the same command");
}

/// What a replay reads.
void try_log(std::string_view text) {
  const auto log = parse_command_log(text);
  if (!log) return require(!log.failure().reason.empty(), "a refusal has a reason");
  std::string written;
  for (const LoggedCommand& logged : *log) written += log_line(logged);
  const auto again = parse_command_log(written);
  require(again && again->size() == log->size(), "what is written is read as the same log");
}

}  // namespace

std::vector<std::string> wheelwright::testing::seeds() {
  const std::vector<Command> commands = {Save{},
                                         Stop{},
                                         Pause{},
                                         Continue{},
                                         Step{},
                                         NewWeights{.strain_energy = 1, .uniformity_dual = 1e4},
                                         NewLoad{},
                                         NewVolume{0.5},
                                         NewWidths{.minimum_wall = 0.005},
                                         NewBound{.constraint = 1, .at_most = 2e6},
                                         Paint{.path = {{0.26, 0}, {0.27, 0.01}}, .radius = 0.01},
                                         MoveHole{.at = {0.26, 0}, .by = {0, 0.01}, .scale = 1.1},
                                         FillHole{.at = {0.26, 0}},
                                         TakeShape{"designs/003/shape.levelset"},
                                         Reset{},
                                         Undo{}};
  std::vector<std::string> seeds;
  std::string log;
  for (const Command& command : commands) {
    seeds.push_back(command_json(command));
    log += log_line({{static_cast<int>(seeds.size()), 1}, command});
  }
  seeds.push_back(log);
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try_command(text);
  try_log(text);
  return 0;
}
