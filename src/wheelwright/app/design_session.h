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
#include "wheelwright/explore/exploration.h"
#include "wheelwright/run/folder_lock.h"

namespace wheelwright {

/// Options of the commands that run many designs.
struct DesignOptions {
  std::optional<std::string> output, quantities;
  std::optional<int> threads, seconds;

  /// --output, --for, --seconds, --threads
  void declare(Options& options);

  /// The quantities that --for names; without it they are what the case minimizes, if that is one of them, or
  /// else stiffness, and run-out, or the radial force variation where the travel is prescribed.
  std::vector<RankedQuantity> chosen_quantities(const Case& c) const;
  int n_threads() const;
};

/// Many designs of one case in a folder of the command's own, on the terminal.
class DesignSession {
 public:
  using Work = std::function<std::vector<RatedDesign>(const RunSettings&)>;

  /// `name` is that of the files that are written: explore, sweep. `settings` is all that the designs follow
  /// from, as text. The time of --seconds begins now. `signals` must outlive this.
  DesignSession(std::string name, std::filesystem::path folder, const DesignOptions& options, const Case& c,
                const Signals& signals, std::string settings);

  /// Whether the folder is free, or holds this session, which continues then. The folder is locked until this
  /// ends. Tells if not: the command ends with exit_refused. Throws OutputError.
  bool may_begin();

  /// How `n_starts` starts are drawn: until a signal comes or the time of --seconds is over. Tells of the
  /// attempts that failed where that takes long or leaves fewer starts.
  DrawingSettings drawing_settings(int n_starts) const;

  /// Runs the designs, writes what is told about them, and prints the best. Returns an ExitCode. Throws
  /// OutputError.
  int run(std::size_t n_designs, const Work& work) const;

 private:
  bool is_time_over() const;
  RunSettings run_settings(std::size_t n_designs) const;
  void show(const Design& design, const DesignResult& result) const;

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

/// Whether a case is one in the plane. Tells if not: the command ends with exit_refused.
bool is_plane_or_tell(const std::string& command, const Case& c, const std::string& file);

/// The case's folder with an ending, e.g. runs/wheel-explore, unless --output gives another one.
std::filesystem::path folder_for(const DesignOptions& options, const Case& c, const std::string& ending);

}  // namespace wheelwright
