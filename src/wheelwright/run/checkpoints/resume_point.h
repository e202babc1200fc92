#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/checkpoints/checkpoint_folder.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// An unusable checkpoint.
struct UnusableCheckpoint {
  std::filesystem::path file;
  std::string reason;
};

/// The checkpoints in a run's folder from which it can continue.
template <int dim>
struct ResumePoint {
  CheckpointFolder checkpoints;
  std::optional<Checkpoint<dim>> newest;     ///< usable one
  std::vector<UnusableCheckpoint> unusable;  ///< newer ones
};

/// The newest checkpoint of this case with an existing history.
template <int dim>
ResumePoint<dim> resume_point(const std::filesystem::path& folder, const Case& c);

}  // namespace wheelwright
