#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/app/options.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/case/case.h"
#include "wheelwright/design/explore/exploration.h"
#include "wheelwright/design/explore/finalists.h"
#include "wheelwright/run/checkpoints/folder_lock.h"

namespace wheelwright {

/// Options of the commands that run many designs.
struct DesignOptions {
  std::optional<std::string> output, quantities;
  std::optional<int> threads, seconds;
  bool without_errors = false;

  /// --output, --for, --seconds, --without-errors, --threads
  void declare(Options& options);

  /// The quantities named by --for. Default: what the case minimizes, if it is one of them, or else
  /// stiffness; and run-out, or the radial force variation if the travel is prescribed.
  /// Fails, in words, if --for names one that the case does not have.
  Expected<std::vector<RankedQuantity>, std::string> chosen_quantities(const Case& c) const;
  int n_threads() const;
};

/// The run of many designs of one case, in the command's own folder, with messages on the terminal.
class DesignSession {
 public:
  using Work = std::function<std::vector<RatedDesign>(const RunSettings&)>;

  /// `name` is the name of the files: explore or sweep. By `quantities` designs are ranked. `settings` is
  /// everything that determines the designs, as text. The time of --seconds starts now. `signals` must
  /// outlive this.
  DesignSession(std::string name, std::filesystem::path folder, const DesignOptions& options, const Case& c,
                const Signals& signals, std::vector<RankedQuantity> quantities, std::string settings);

  /// Whether the folder is free or contains this session, which then continues. Locks the folder for the
  /// lifetime of this object. Otherwise prints why: the command ends with exit_refused. Throws OutputError.
  bool may_begin();

  /// Settings to generate `n_starts` starts until a signal arrives or the time of --seconds is over. Reports
  /// failed attempts if generation takes long or yields fewer starts.
  DrawingSettings drawing_settings(int n_starts) const;

  /// Runs the designs, solves the finalists on a finer grid, unless no errors are wanted, writes page and
  /// tables, and prints the best. Returns an ExitCode. Throws OutputError.
  int run(std::size_t n_designs, const Work& work) const;

 private:
  bool is_time_over() const;
  RunSettings run_settings(std::size_t n_designs) const;
  FinalistSettings finalist_settings() const;
  void show(const Design& design, const DesignResult& result) const;
  void show_finalist(const RatedDesign& finalist) const;
  int end_of_stopped(bool has_designs, int signal) const;
  void print_results(const std::vector<RankedDesign>& order) const;

  std::string name_;
  std::filesystem::path folder_;
  const DesignOptions& options_;
  const Case& case_;
  const Signals& signals_;
  std::string settings_;
  std::vector<RankedQuantity> quantities_;
  Stopwatch watch_;
  std::optional<FolderLock> lock_;
};

/// Whether a case is in 2D. If not, prints a message: the command ends with exit_refused.
bool is_plane_or_report(const std::string& command, const Case& c, const std::string& file);

/// The case's folder with a suffix, e.g. runs/wheel-explore, unless --output gives another one.
std::filesystem::path folder_for(const DesignOptions& options, const Case& c, const std::string& ending);

}  // namespace wheelwright
