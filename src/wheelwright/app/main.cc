#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <system_error>

#include "wheelwright/app/check.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/load_list.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/blas_settings.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/shorten.h"
#include "wheelwright/case/version.h"
#include "wheelwright/case/write.h"

namespace wheelwright {

namespace {

struct CommandLine {
  std::string case_file;
  std::string run_folder;
  std::string template_file = "case.toml";
  std::optional<std::string> output_folder;
  std::optional<int> iterations;
  std::optional<int> threads;
  int analyzed_positions = 64;
  std::string loads;
  bool json = false;
};

constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    a bug in the program\n"
    "  2    wrong command line, or the case has errors or cannot be read\n"
    "  3    the solver gave up\n"
    "  4    refused: a file would be overwritten, another run is writing to the folder, or there is too "
    "little memory\n"
    "  5    a file could not be written\n"
    "  6    no checkpoint can be used\n"
    "  7    done, but the results differ from those that the case expects\n"
    "  129  stopped by SIGHUP (the terminal was closed) and saved\n"
    "  130  stopped by SIGINT (Ctrl-C) and saved\n"
    "  143  stopped by SIGTERM or by a file STOP in the run's folder, and saved";

std::string count_of_problems(std::size_t n) { return fmt::format("{} problem{}", n, n == 1 ? "" : "s"); }

int report_problems(const std::string& file, const std::vector<Diagnostic>& problems) {
  for (const Diagnostic& problem : problems) tell("{}\n", problem.text());
  tell("{}\n", styled(stderr, Style::red, fmt::format("{}: {}", file, count_of_problems(problems.size()))));
  return exit_usage;
}

void print_warning(std::FILE* stream, const std::string& text) {
  std::fputs(fmt::format("{} {}\n", styled(stream, Style::yellow, "warning:"), text).c_str(), stream);
}

void print_warnings(std::FILE* stream, const Case& c) {
  for (const std::string& text : warnings(c)) print_warning(stream, text);
}

int check(const CommandLine& line) {
  const CaseResult result = read_case(line.case_file);
  if (!result.value) return report_problems(line.case_file, result.problems);
  fmt::print("{}\n", styled(stdout, Style::green, line.case_file + ": no problems"));
  fmt::print("{}", derived_report(*result.value));
  print_warnings(stdout, *result.value);
  if (const auto lack = lack_of_memory(*result.value, available_memory()))
    print_warning(stdout, "this case cannot run here: " + *lack);
  return exit_done;
}

int init(const CommandLine& line) {
  const int file = open(line.template_file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) {
    const int reason = errno;
    tell("{}: {}\n", line.template_file, std::strerror(reason));
    return reason == EEXIST ? exit_refused : exit_input_output;
  }
  std::FILE* stream = fdopen(file, "w");
  const std::string text = case_template();
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (std::fclose(stream) != 0 || !written) {
    tell("{}: cannot be written\n", line.template_file);
    return exit_input_output;
  }
  fmt::print("wrote {0}; next: wheelwright check {0}\n", line.template_file);
  return exit_done;
}

int compute(const std::string& command, const CommandLine& line) {
  CaseResult result = read_case(line.case_file);
  if (!result.value) return report_problems(line.case_file, result.problems);
  Case& c = *result.value;
  if (line.iterations) c = with_iterations(std::move(c), *line.iterations);
  print_warnings(stderr, c);
  RunOptions options{.case_file = line.case_file, .threads = line.threads};
  if (line.output_folder) options.output = *line.output_folder;
  return run_command_named(command, c, options);
}

int resume(const CommandLine& line) {
  const std::filesystem::path case_file = std::filesystem::path(line.run_folder) / "case.toml";
  if (!std::filesystem::exists(case_file)) {
    tell("{}: this folder holds no run; there is no {}\n", line.run_folder, case_file.string());
    return exit_usage;
  }
  CaseResult result = read_case(case_file);
  if (!result.value) return report_problems(case_file.string(), result.problems);
  Case& c = *result.value;
  if (line.iterations) c = with_iterations(std::move(c), *line.iterations);
  print_warnings(stderr, c);
  return run_command_named("resume", c,
                           {.case_file = case_file, .run_folder = line.run_folder, .threads = line.threads});
}

int analyze(const CommandLine& line) {
  CaseResult result = read_case(line.case_file);
  if (!result.value) return report_problems(line.case_file, result.problems);
  Case& c = *result.value;
  c.load.positions = line.analyzed_positions;
  print_warnings(stderr, c);
  RunOptions options{.case_file = line.case_file, .threads = line.threads, .json = line.json};
  if (line.output_folder) options.output = *line.output_folder;
  if (!line.loads.empty()) options.loads = *parse_loads(line.loads);
  return run_command_named("analyze", c, options);
}

Range range_of_iterations() {
  const auto* key = find_key(optimizer_section().keys, "iterations");
  return std::get<IntegerField<Optimizer>>(key->field).range;
}

CLI::App* add_case_command(CLI::App& app, CommandLine& line, const std::string& name,
                           const std::string& meaning) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->add_option("CASE", line.case_file, "case file")->required();
  return command;
}

std::string not_empty(const std::string& text) { return text.empty() ? "must not be empty" : ""; }

void add_output_option(CLI::App& command, CommandLine& line, const std::string& meaning) {
  command.add_option("--output", line.output_folder, meaning)->type_name("DIR")->check(not_empty);
}

void declare_analyze(CLI::App& app, CommandLine& line) {
  constexpr int most_positions = 1000;
  CLI::App* analyze =
      add_case_command(app, line, "analyze", "Report stiffness, contact, stress and run-out of one shape");
  analyze->add_option("--positions", line.analyzed_positions, "Load positions per sector")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, most_positions));
  analyze->add_option("--loads", line.loads, "Report the deflection under these loads on the whole width [N]")
      ->type_name("P1,P2,... | FROM:TO:NUMBER")
      ->check([](const std::string& text) {
        return parse_loads(text) ? "" : "must be loads > 0, as in 1000,2000 or 500:3000:6";
      });
  add_output_option(*analyze, line, "Folder for JSON and plots; without it only the table is printed");
  analyze->add_flag("--json", line.json, "Print JSON instead of the table");
}

void add_iterations_option(CLI::App& command, CommandLine& line) {
  const Range range = range_of_iterations();
  command
      .add_option(
          "--iterations", line.iterations,
          "Number of shapes instead of the case's optimizer.iterations; expectations of later shapes, or "
          "of the last one, are not checked")
      ->type_name("N")
      ->check(CLI::Range(static_cast<int>(range.low), static_cast<int>(range.high)));
}

void add_threads_option(CLI::App& command, CommandLine& line) {
  constexpr int most_threads = 1024;
  command
      .add_option(
          "--threads", line.threads,
          "Number of threads, at most the number of processors, which is the default. The results do not "
          "depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, most_threads));
}

void declare_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("wheelwright {}", version()));
  app.footer(exit_codes);
  CLI::App* run = add_case_command(app, line, "run", "Optimize a case and write the results to its folder");
  add_output_option(*run, line, "Folder for the results, instead of the case's output.folder");
  add_iterations_option(*run, line);
  CLI::App* resume = app.add_subcommand("resume", "Resume a run that was stopped");
  resume->add_option("DIR", line.run_folder, "folder of the run")->required()->check(not_empty);
  add_iterations_option(*resume, line);
  declare_analyze(app, line);
  CLI::App* verify =
      add_case_command(app, line, "verify", "Test the shape gradient and the balance of forces on a case");
  for (CLI::App* command : {run, resume, app.get_subcommand("analyze"), verify})
    add_threads_option(*command, line);
  add_case_command(app, line, "check", "Report all problems of a case, or the numbers derived from it");
  app.add_subcommand("init", "Write a commented case file to start from")
      ->add_option("FILE", line.template_file, "File to write; an existing file is never overwritten")
      ->capture_default_str();
  app.add_subcommand("reference", "Print the reference page for all keys of a case file");
}

int dispatch(const std::string& command, const CommandLine& line) {
  if (command == "check") return check(line);
  if (command == "init") return init(line);
  if (command == "resume") return resume(line);
  if (command == "analyze") return analyze(line);
  if (command == "reference") {
    fmt::print("{}", case_reference_markdown());
    return exit_done;
  }
  return compute(command, line);
}

int parse_and_dispatch(int argc, char** argv) {
  CLI::App app("Optimizes the shape of elastic rolling structures");
  CommandLine line;
  declare_commands(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_usage;
  }
  return dispatch(app.get_subcommands().front()->get_name(), line);
}

/// Lost output, e.g. on a full disk, turns success into failure.
int after_flushing(int code) {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout);
  if (!lost) return code;
  tell("wheelwright: standard output cannot be written\n");
  return code == exit_done ? exit_input_output : code;
}

}  // namespace

}  // namespace wheelwright

int main(int argc, char** argv) {
  wheelwright::restart_with_blas_settings(argv);
  try {
    return wheelwright::after_flushing(wheelwright::parse_and_dispatch(argc, argv));
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "wheelwright: %s\n", error.what());
    return wheelwright::exit_input_output;
  } catch (const std::bad_alloc&) {
    std::fputs("wheelwright: out of memory\n", stderr);
    return wheelwright::exit_refused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "wheelwright: bug: %s\n", error.what());
    return wheelwright::exit_bug;
  }
}
