#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "wheelwright/explore/design.h"

namespace wheelwright {

/// Names in the folder of an exploration: the folder of the designs' runs.
inline constexpr const char* folder_of_designs = "designs";

/// How designs are run.
struct RunSettings {
  int threads = 1;  ///< runs at a time, of one thread each; the results do not depend on it
  /// Asked several times a second: whether to stop, saved.
  std::function<bool()> stop_requested = [] { return false; };
  /// Asked before each design: whether there is time for another one.
  std::function<bool()> may_begin = [] { return true; };
  /// Told of each result, by one thread at a time.
  std::function<void(const Design&, const DesignResult&)> done = [](const Design&, const DesignResult&) {};
  /// Told of each design whose folder cannot be used, and why, by one thread at a time.
  std::function<void(const Design&, const std::string& why)> left_out = [](const Design&,
                                                                           const std::string&) {};
};

/// Runs designs in folder/designs/NAME and returns their results, in their order; empty for those that were
/// not begun, were stopped, or whose folder cannot be used, for example because another process writes to it.
/// A result that the folder holds already is read; a run that was interrupted is resumed; a preview is
/// continued to the end. Throws OutputError.
std::vector<std::optional<DesignResult>> run_designs(const std::filesystem::path& folder,
                                                     const std::vector<Design>& designs,
                                                     Progression progression, const RunSettings& settings);

}  // namespace wheelwright
