#pragma once

#include <filesystem>
#include <optional>

namespace wheelwright {

/// Memory that this process may still take without swapping [bytes]: the minimum of what Linux calls
/// available and what the control groups of the process, version 1 or 2, leave below their limits. Nothing if
/// neither is known. `root` is the folder that contains proc and sys.
std::optional<double> available_memory(const std::filesystem::path& root = "/");

}  // namespace wheelwright
