#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/contact_progress.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/observers/solved_report.h"

namespace wheelwright {
namespace {

/// The page of an exploration or a sweep; its points link to the reports of the designs.
std::optional<std::filesystem::path> page_of_designs(const std::filesystem::path& folder) {
  for (const char* name : {"explore.html", "sweep.html"})
    if (is_there(folder / name)) return folder / name;
  return {};
}

class ReportCommand : public Subcommand {
 public:
  ReportCommand() : Subcommand("report", "Write a page that explains one or more runs") {}

  void declare(Options& options) override {
    options.arguments("RUN", folders_, 1,
                      "Folders of runs; several are shown side by side. For an exploration or a sweep, "
                      "prints where its page is");
    options.text("--output", "FILE", output_, not_empty, "The file to write; default report.html");
    add_threads(options, threads_);
  }

  int run() override {
    if (const auto page = page_of_designs(folders_.front()); page && folders_.size() == 1) {
      fmt::print("{}\n", page->string());
      return exit_done;
    }
    const std::string file = output_.value_or("report.html");
    if (is_there(file)) {
      print_err("{}: exists already; choose another file with --output, or remove it\n", file);
      return exit_refused;
    }
    std::vector<PageRun> runs;
    std::vector<AnyRun> inputs;
    for (const std::string& folder : folders_) {
      auto input = read_run_or_report(folder, {name(), threads_});
      if (!input) return input.failure();
      inputs.push_back(*std::move(input));
    }
    for (const AnyRun& input : inputs) {
      auto report = std::visit(
          [](const auto& run) {
            return solved_page_run(run.folder, run.source, run.checkpoint, print_contact_progress());
          },
          input);
      if (!report) return report_failure(name(), report.failure());
      runs.push_back(*std::move(report));
    }
    write_atomically(file, report_page(runs));
    fmt::print("{}\n", file);
    return exit_done;
  }

 private:
  std::vector<std::string> folders_;
  std::optional<std::string> output_;
  std::optional<int> threads_;
};

}  // namespace

std::unique_ptr<Subcommand> make_report() { return std::make_unique<ReportCommand>(); }

}  // namespace wheelwright
