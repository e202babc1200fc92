#pragma once

#include <filesystem>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The file in a run's folder with its current case.
inline constexpr const char* case_file = "case.toml";

/// Writes it, with its drawings and its saved shape. Throws OutputError.
void write_case_file(const std::filesystem::path& folder, const Case& c);

}  // namespace wheelwright
