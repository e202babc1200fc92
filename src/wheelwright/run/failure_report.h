#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "wheelwright/run/model.h"
#include "wheelwright/optimize/optimizer.h"

namespace wheelwright {

/// Why a run could not go on: its last accepted shape, if there is one, and the trials that failed after it,
/// in their order; at least one.
struct GivenUp {
  std::optional<OptimizationState<2>> last;
  std::span<const Trial<2>> trials;
};

/// Writes what is needed to look into it to RUN_FOLDER/failure: report.txt with every failed trial, a picture
/// of the last one's shape, its level set and that of the last accepted shape, and the case. Returns the text
/// for the terminal. Throws OutputError.
std::string write_failure(const std::filesystem::path& run_folder, const Case& c, const GivenUp& failure);

}  // namespace wheelwright
