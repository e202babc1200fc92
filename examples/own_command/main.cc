// Optimizes the wheel of a case file in a folder, with the commands of a log at their moments, among them one
// that the library does not know. Prints accepted shapes and commands. Resumes the run that is in the folder.
// usage: own_command CASE FOLDER LOG

#include <wheelwright/run/checkpoints/case_file.h>
#include <wheelwright/run/observers/command_log.h>
#include <wheelwright/wheelwright.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "scale_load.h"
#include "shape_printer.h"

using namespace wheelwright;

namespace {

std::string content(const char* file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

CommandKinds known_commands() {
  CommandKinds kinds = commands_of_every_run();
  kinds.push_back(command_kind<ScaleLoad>());
  return kinds;
}

}  // namespace

int main(int count, char** arguments) {
  restart_with_blas_settings(arguments);
  if (count != 4) return 2;
  const std::filesystem::path folder = arguments[2];
  const bool exists = std::filesystem::exists(folder / case_file);
  const CaseResult wheel = read_case(exists ? folder / case_file : std::filesystem::path(arguments[1]));
  for (const Diagnostic& problem : wheel.problems) std::fprintf(stderr, "%s\n", problem.text().c_str());
  auto log = parse_command_log(content(arguments[3]), known_commands());
  if (!log) std::fprintf(stderr, "%s: %s\n", arguments[3], log.failure().reason.c_str());
  if (!wheel.value || !log) return 2;

  auto run = exists ? Run<2>::resume(*wheel.value, folder) : Run<2>::begin(*wheel.value, folder);
  if (!run) return 1;
  CommandQueue commands;
  auto replay = std::make_unique<CommandReplay<2>>(*std::move(log));
  commands.add_source(replay->source());
  run->add(std::make_unique<CommandLog<2>>());
  run->add(std::make_unique<ShapePrinter>());
  run->add(std::move(replay));
  return run->execute(commands).state ? 0 : 1;
}
