#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/app/options.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/case/case.h"
#include "wheelwright/explore/exploration.h"

namespace wheelwright {

/// Options of the commands that run many designs.
struct DesignOptions {
  std::optional<std::string> output, quantities;
  std::optional<int> threads, seconds;

  /// --output, --for, --seconds, --threads
  void declare(Options& options);

  std::vector<RankedQuantity> chosen_quantities() const;
  int n_threads() const;
};

/// Many designs of one case in a folder of the command's own, on the terminal.
class DesignSession {
 public:
  using Work = std::function<std::vector<RatedDesign>(const RunSettings&)>;

  /// `name` is that of the files that are written: explore, sweep. `settings` is all that the designs follow
  /// from, as text.
  DesignSession(std::string name, std::filesystem::path folder, const DesignOptions& options,
                std::string settings);

  /// Whether the folder is free, or holds this session, which goes on then. Tells if not: the command ends
  /// with exit_refused. Throws OutputError.
  bool may_begin();

  /// Runs the designs, writes what is told about them, and prints the best. Returns an ExitCode. Throws
  /// OutputError.
  int run(const Case& c, std::size_t n_designs, Signals& signals, const Work& work) const;

 private:
  RunSettings run_settings(const Case& c, std::size_t n_designs, Signals& signals) const;
  void show(const Design& design, const DesignResult& result) const;

  std::string name_;
  std::filesystem::path folder_;
  const DesignOptions& options_;
  std::string settings_;
};

/// Whether a case is one in the plane. Tells if not: the command ends with exit_refused.
bool is_plane_or_tell(const std::string& command, const Case& c, const std::string& file);

/// The case's folder with an ending, e.g. runs/wheel-explore, unless --output gives another one.
std::filesystem::path folder_for(const DesignOptions& options, const Case& c, const std::string& ending);

}  // namespace wheelwright
