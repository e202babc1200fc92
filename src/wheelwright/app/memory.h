#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheelwright/base/available_memory.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Why the available memory is too small for a case, and what helps; nothing if it suffices.
std::optional<std::string> lack_of_memory(const Case& c, std::optional<double> available);

/// Address space left to this process by a limit (`ulimit -v`) [bytes]. Nothing without a limit.
std::optional<double> address_space_left(const std::filesystem::path& root = "/");

/// Why the address space left is too small for a case on that many threads; nothing if it suffices. Each
/// thread maps far more than it uses, and BLAS would retry forever to map its buffers.
std::optional<std::string> lack_of_address_space(const Case& c, int n_threads, std::optional<double> left);

}  // namespace wheelwright
