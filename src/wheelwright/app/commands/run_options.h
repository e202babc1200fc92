#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace wheelwright {

/// What the command line says besides the case; options that override keys are already in the case.
struct RunOptions {
  std::filesystem::path case_file;
  std::filesystem::path run_folder = {};  ///< resume
  std::optional<std::filesystem::path> output =
      {};                           ///< run: instead of the case's folder; analyze: folder for its files
  std::vector<double> loads = {};   ///< analyze: on the whole width [N], ascending
  std::optional<int> threads = {};  ///< at most; as many as there are processors without it
  bool json = false;                ///< analyze: JSON instead of the table
};

}  // namespace wheelwright
