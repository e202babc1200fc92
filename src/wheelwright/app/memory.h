#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Memory that this process may still take without swapping [bytes]: the least of what Linux calls available
/// and what the control groups of the process, version 1 or 2, leave below their limits. Nothing where
/// neither is known. `root` is the folder that holds proc and sys.
std::optional<double> available_memory(const std::filesystem::path& root = "/");

/// Why a case must not be computed with that much memory available: what it needs and what helps. Nothing if
/// it may.
std::optional<std::string> lack_of_memory(const Case& c, std::optional<double> available);

}  // namespace wheelwright
