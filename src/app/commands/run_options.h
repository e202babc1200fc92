#pragma once

#include <filesystem>

namespace wheelwright {

/// What the command line says besides the case; options that override keys are already in the case.
struct RunOptions {
  std::filesystem::path case_file;
};

}  // namespace wheelwright
