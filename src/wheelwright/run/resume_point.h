#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/checkpoint_folder.h"
#include "wheelwright/run/study.h"

namespace wheelwright {

/// A checkpoint that cannot be used.
struct UnusableCheckpoint {
  std::filesystem::path file;
  std::string reason;
};

/// What a run's folder holds to continue from.
template <int dim>
struct ResumePoint {
  CheckpointFolder checkpoints;
  std::optional<Checkpoint<dim>> newest;     ///< that can be used
  std::vector<UnusableCheckpoint> unusable;  ///< that are newer
};

/// The newest checkpoint of this case whose history is there.
template <int dim>
ResumePoint<dim> resume_point(const std::filesystem::path& folder, const Case& c);

}  // namespace wheelwright
