#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/app/options.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/case/case.h"
#include "wheelwright/design/explore/exploration.h"
#include "wheelwright/design/explore/finalists.h"

namespace wheelwright {

/// Options of the commands that run many designs.
struct WorkOptions {
  std::optional<int> threads, seconds;
  bool without_errors = false;

  /// --seconds, --without-errors, --threads
  void declare(Options& options);

  int n_threads() const;
};

/// Runs the designs of a plan in its folder, with messages on the terminal. Other processes may run designs
/// of the same folder. Functions that return int return an ExitCode; all of them throw OutputError.
class DesignSession {
 public:
  /// The time of --seconds began with `watch`. The references must outlive this.
  DesignSession(std::filesystem::path folder, DesignPlan plan, const WorkOptions& options,
                const Signals& signals, const Stopwatch& watch);

  /// Prints what the designs will cost, and how they are run.
  int show_plan() const;

  /// Runs all designs, solves the finalists on a finer grid unless no errors are wanted, and collects.
  int run();

  /// Takes one design as far as it goes without the results of others that are not there yet.
  int run_only(const std::string& design);

  /// Writes page and tables from the results that are there, prints the best, and says what is missing.
  int collect();

 private:
  bool is_time_over() const;
  bool has_finalists() const;
  /// How many designs of so many bytes of memory run at once.
  int at_once(double bytes) const;
  RunSettings run_settings(int at_once);
  FinalistSettings finalist_settings(int at_once);
  std::vector<RatedDesign> run_all();
  std::vector<RatedDesign> solve_finalists(const std::vector<RatedDesign>& designs);
  void show(const Design& design, const DesignResult& result) const;
  void show_finalist(const RatedDesign& finalist) const;
  /// The next step of a design. False if none is due.
  bool run_next_step(const std::string& design, const RunSettings& settings);
  int write(const std::vector<RatedDesign>& designs);
  int end_of_stopped(int code) const;
  void print_results(const std::vector<RankedDesign>& order) const;

  std::filesystem::path folder_;
  DesignPlan plan_;
  const WorkOptions& options_;
  const Signals& signals_;
  const Stopwatch& watch_;
};

}  // namespace wheelwright
