#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/open_browser.h"
#include "wheelwright/app/run_messages.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/watch_status.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/observers/command_log.h"
#include "wheelwright/web/server/local_server.h"
#include "wheelwright/web/watch/session.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Whether the descriptor is a regular file, which keeps what is printed.
bool is_kept(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Nothing if the file cannot be read.
std::optional<std::string> content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !is_file(file)) return {};
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

class WatchCommand : public Subcommand {
 public:
  WatchCommand()
      : Subcommand("watch", "Optimize a case while a page in the browser shows and steers the run") {}

  void declare(Options& options) override {
    options.argument("WHEEL", input_, not_empty,
                     "A case file to start from, or the folder of a run to continue");
    add_output(options, output_, "Folder for the results, instead of the case's output.folder");
    options.number("--port", port_, {0, 65535}, "Port of the page on this machine; 0: any free port");
    options.flag("--no-browser", no_browser_, "Only print the address of the page");
    options.text("--replay", "FILE", replay_, not_empty,
                 "Replay the commands of a commands.jsonl, without a page");
    options.text("--designs", "DIR", designs_, not_empty,
                 "Offer the designs in the folder of an exploration or a sweep");
    add_threads(options, threads_);
  }

  int run() override {
    Signals signals;
    const bool is_run = is_folder(input_);
    const fs::path case_file = is_run ? fs::path(input_) / "case.toml" : fs::path(input_);
    auto c = read_or_report(case_file);
    if (!c || !find_designs() || !read_replay()) return exit_usage;
    if (!may_compute(name(), *c, case_file, threads_)) return exit_refused;
    const fs::path folder = is_run ? fs::path(input_) : fs::path(output_.value_or(c->output.folder));
    return in_dimension_of(*c, [&](auto dim) {
      auto run = is_run ? Run<dim>::resume(*c, folder) : Run<dim>::begin(watched_case(*c), folder);
      if (!run) return report_not_begun<dim>(run.failure(), folder);
      if (is_run) report_resumption(run->resumption(), folder);
      run->add(std::make_unique<WatchStatus<dim>>(stderr));
      commands_.add_source([&signals] { return signals.next_command(); });
      return log_ ? replay(*run, signals) : serve(*run, signals);
    });
  }

 private:
  bool find_designs() {
    if (!designs_) return true;
    auto found = offered_designs(*designs_);
    if (!found) {
      print_err("wheelwright watch: --designs: {}\n", found.failure().reason);
      return false;
    }
    offered_ = *std::move(found);
    return true;
  }

  /// Reads the commands to replay, before the run creates its folder.
  bool read_replay() {
    if (!replay_) return true;
    const auto text = content(*replay_);
    if (!text) {
      print_err("{}: cannot be read; check its name and permissions\n", *replay_);
      return false;
    }
    auto log = parse_command_log(*text);
    if (!log) {
      print_err("{}: {}\n", *replay_, log.failure().reason);
      return false;
    }
    log_ = *std::move(log);
    return true;
  }

  template <int dim>
  int serve(Run<dim>& run, const Signals& signals) {
    WatchSession<dim> session(commands_, offered_);
    session.watch(run);
    const LocalServer server(session.routes(), port_);
    const AddressFile address(server.address());
    tell_address(server, address);
    const auto result = run.execute(commands_, OnEnd::wait);
    session.close();
    return report_result(result, run.folder(), signals);
  }

  void tell_address(const LocalServer& server, const AddressFile& address) const {
    if (is_kept(STDOUT_FILENO))
      print("the page is at http://127.0.0.1:{}/; open {} to enter\n", server.port(),
            address.path().string());
    else
      print("{}\n", server.address());
    std::fflush(stdout);
    if (!no_browser_) std::thread([file = address.path()] { open_browser(file); }).detach();
  }

  template <int dim>
  int replay(Run<dim>& run, const Signals& signals) {
    auto replay = std::make_unique<CommandReplay<dim>>(*std::move(log_));
    commands_.add_source(replay->source());
    run.add(std::make_unique<CommandLog<dim>>());
    run.add(std::move(replay));
    return report_result(run.execute(commands_, OnEnd::wait), run.folder(), signals);
  }

  std::string input_;
  std::optional<std::string> output_, replay_, designs_;
  std::optional<std::vector<LoggedCommand>> log_;  ///< of replay_
  OfferedDesigns offered_;
  int port_ = 0;
  bool no_browser_ = false;
  std::optional<int> threads_;
  CommandQueue commands_;
};

}  // namespace

std::unique_ptr<Subcommand> make_watch() { return std::make_unique<WatchCommand>(); }

}  // namespace wheelwright
