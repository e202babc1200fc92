#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "wheelwright/design/explore/design.h"

namespace wheelwright {

/// Names in the folder of an exploration: the folder of the designs' runs.
inline constexpr const char* folder_of_designs = "designs";

/// Settings for running designs.
struct RunSettings {
  int threads = 1;  ///< number of concurrent runs of one thread each; results do not depend on it
  /// Called several times a second: whether to save and stop.
  std::function<bool()> stop_requested = [] { return false; };
  /// Called before each design: whether there is time for another one.
  std::function<bool()> may_begin = [] { return true; };
  /// Called with each result, by one thread at a time.
  std::function<void(const Design&, const DesignResult&)> done = [](const Design&, const DesignResult&) {};
  /// Called for each design whose folder cannot be used, with the reason, by one thread at a time.
  std::function<void(const Design&, const std::string& why)> left_out = [](const Design&,
                                                                           const std::string&) {};
};

/// Runs designs in folder/designs/NAME and returns their results, in their order; empty for those that were
/// not started, were stopped, or whose folder cannot be used, for example because another process writes to
/// it. Existing results are read, interrupted runs resumed, and previews continued to the end. Throws
/// OutputError.
std::vector<std::optional<DesignResult>> run_designs(const std::filesystem::path& folder,
                                                     const std::vector<Design>& designs,
                                                     Progression progression, const RunSettings& settings);

}  // namespace wheelwright
