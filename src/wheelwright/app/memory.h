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

/// Address space that a limit (`ulimit -v`) leaves to this process [bytes]. Nothing without a limit.
std::optional<double> address_space_left(const std::filesystem::path& root = "/");

/// Why a case must not be computed on so many threads with that much address space left: each thread maps far
/// more than it uses, and BLAS would try again for ever to map its buffers. Nothing if it may.
std::optional<std::string> lack_of_address_space(const Case& c, int n_threads, std::optional<double> left);

}  // namespace wheelwright
