#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/guarded.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/text.h"
#include "wheelwright/case/suggest.h"
#include "wheelwright/run/checkpoints/provenance.h"

namespace wheelwright {
namespace {

using Commands = std::vector<std::unique_ptr<Subcommand>>;

void declare(CLI::App& app, const Commands& commands) {
  app.require_subcommand(1);
  app.set_version_flag("--version", program_text());
  app.footer(exit_code_list());
  for (const auto& command : commands) {
    Options options(*app.add_subcommand(command->name(), command->meaning()));
    command->declare(options);
  }
}

/// The arguments that no command declares, in the order in which they were given.
std::string unexpected(const CLI::App& app) {
  std::string text;
  for (const std::string& argument : app.remaining(true)) text += (text.empty() ? "" : " ") + argument;
  return without_control_characters(text);
}

/// The complaint about the first argument if it is a word that is no command.
std::optional<std::string> unknown_command(const Commands& commands, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const auto& command : commands) names.push_back(command->name());
  if (std::ranges::find(names, word) != names.end()) return {};
  const auto near = did_you_mean(word, {names.begin(), names.end()});
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return fmt::format("{}: no such command; {}", without_control_characters(word),
                     near ? fmt::format("did you mean {}?", *near) : "the commands are " + all);
}

int parse_and_run(int argc, char** argv) {
  const Commands commands = make_commands();
  if (const auto complaint = unknown_command(commands, argc, argv)) {
    print_err("{}\n", *complaint);
    return exit_usage;
  }
  CLI::App app("Optimizes the shape of elastic rolling structures");
  declare(app, commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    print_err("not expected: {}\nRun with --help for more information.\n", unexpected(app));
    return exit_usage;
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, messages;
    const bool is_help = app.exit(error, out, messages) == 0;
    print_lines(stdout, out.str());
    print_lines(stderr, messages.str());
    return is_help ? exit_done : exit_usage;
  }
  const std::string name = app.get_subcommands().front()->get_name();
  const auto chosen = std::ranges::find(commands, name, [](const auto& command) { return command->name(); });
  return guarded("wheelwright " + name, [&] { return (*chosen)->run(); });
}

/// Turns success into failure if output is lost, e.g. on a full disk.
int after_flushing(int code) {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout);
  if (!lost) return code;
  print_err("wheelwright: standard output cannot be written\n");
  return code == exit_done ? exit_input_output : code;
}

}  // namespace
}  // namespace wheelwright

int main(int argc, char** argv) {
  wheelwright::restart_with_blas_settings(argv);
  wheelwright::keep_freed_memory();
  return wheelwright::guarded(
      "wheelwright", [&] { return wheelwright::after_flushing(wheelwright::parse_and_run(argc, argv)); });
}
