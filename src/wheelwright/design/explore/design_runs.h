#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "wheelwright/design/explore/design.h"
#include "wheelwright/run/checkpoints/folder_lock.h"

namespace wheelwright {

/// Names in the folder of an exploration: the folder of the designs' runs.
inline constexpr const char* folder_of_designs = "designs";

/// Shapes of a preview whose run does not start on a coarser grid.
inline constexpr int shapes_of_preview = 15;

/// Settings for running designs.
struct RunSettings {
  int threads = 1;  ///< number of concurrent runs; results do not depend on it
  /// Called several times a second: whether to save and stop.
  std::function<bool()> stop_requested = [] { return false; };
  /// Called before each design: whether there is time for another one.
  std::function<bool()> may_begin = [] { return true; };
  /// Called with the number of each accepted shape of a design, by several threads: whether to save the
  /// design and leave it at this shape. Run again, it continues from there. A preview that ends at this shape
  /// ends.
  std::function<bool(const Design&, int)> pauses = [](const Design&, int) { return false; };
  /// Called with each result, by one thread at a time.
  std::function<void(const Design&, const DesignResult&)> done = [](const Design&, const DesignResult&) {};
  /// Called several times a second for each design that another process runs, by several threads: whether to
  /// wait for its result.
  std::function<bool(const Design&, const FolderInUse&)> waits = [](const Design&, const FolderInUse&) {
    return false;
  };
  /// Called for each design that cannot be run, with the reason, by one thread at a time.
  std::function<void(const Design&, const std::string& why)> left_out = [](const Design&,
                                                                           const std::string&) {};
};

/// The stored result of a design in folder/designs; nothing if it was not run that far.
std::optional<DesignResult> known_result(const std::filesystem::path& folder, const Design& design,
                                         Progression progression);

/// The file that a process locks while it works on a design of a folder.
std::filesystem::path lock_of_design(const std::filesystem::path& folder, const Design& design);

/// Makes the folder of the designs, with their subfolders, and lists all names that are written there, so
/// that processes that share the work do not write to one list (files/written_files.h). Throws OutputError.
void prepare_designs(const std::filesystem::path& folder, const std::vector<Design>& designs);

/// Runs designs in folder/designs/NAME and returns their results, in their order; empty for those that were
/// not started, were stopped, or whose folder cannot be used. Existing results are read, interrupted runs
/// resumed, and previews continued to the end. Other processes may do the same at the same time: each design
/// is run by one of them, and the others wait for its result if the settings say so. Throws OutputError.
std::vector<std::optional<DesignResult>> run_designs(const std::filesystem::path& folder,
                                                     const std::vector<Design>& designs,
                                                     Progression progression, const RunSettings& settings);

}  // namespace wheelwright
