#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "wheelwright/run/checkpoints/checkpoint_folder.h"
#include "wheelwright/run/checkpoints/folder_lock.h"
#include "wheelwright/run/checkpoints/resume_point.h"
#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/observers/expectations.h"
#include "wheelwright/run/observers/observer.h"
#include "wheelwright/run/study/parting_planes.h"

namespace wheelwright {

// Why a run did not start or resume.
struct FolderHoldsARun {};
/// The run would replace files not written by a run.
struct ForeignFiles {
  std::vector<std::string> names;
};
struct CheckpointsGone {};  ///< its history contains trials, but there is no checkpoint
struct NoUsableCheckpoint {
  std::vector<UnusableCheckpoint> unusable;
};
struct CheckpointMisfit {
  std::string reason;
};
template <int dim>
struct AlreadyFinished {
  Checkpoint<dim> end;
  std::vector<Finding> findings;             ///< for the expectations of the case
  std::vector<UnusableCheckpoint> unusable;  ///< checkpoints that are newer
};
template <int dim>
using NotBegun = std::variant<FolderInUse, FolderHoldsARun, ForeignFiles, CheckpointsGone, NoUsableCheckpoint,
                              CheckpointMisfit, AlreadyFinished<dim>, Failure>;

/// What a run is resumed from; all empty for a new run.
struct Resumption {
  std::vector<UnusableCheckpoint> unusable;  ///< checkpoints that are newer
  std::optional<int> shape;                  ///< empty: no checkpoint yet, the run starts from the beginning
  std::optional<std::string> other_program;  ///< that saved the checkpoint, if it differs from this one
};

/// What a run does when it has a reason to end by itself.
enum class OnEnd {
  finish,  ///< writes its results
  wait,    ///< waits for commands; only Stop ends it. Continue and Step search for better shapes again
};

/// How a run ended.
template <int dim>
struct RunResult {
  StopReason reason;
  std::optional<OptimizationState<dim>> state;  ///< the last accepted shape; empty after a failed start
  std::optional<InitialShape<dim>> initial;
  std::vector<Trial<dim>> failed_trials;  ///< after the last accepted shape
  std::vector<Finding> findings;          ///< for the expectations of the case; of a run that ended by itself
  std::optional<RunSummary<dim>> summary;  ///< empty after a failed start
  double elapsed_seconds;
  bool is_approaching = false;  ///< whether the volume has not reached its target yet
};

/// One optimization of a case in its folder, from its start or from its newest checkpoint to its end. Locks
/// the folder for the lifetime of this object.
template <int dim>
class Run {
 public:
  /// Refuses a folder that contains a run, or files of the user that the run would replace, and leaves such a
  /// folder unchanged. Throws OutputError.
  static Expected<Run, NotBegun<dim>> begin(const Case& c, const std::filesystem::path& folder) {
    return begin(c, folder, PlaneSearch());
  }
  /// The same, for a case that looks for its parting plane: the run's case has the one that it finds.
  static Expected<Run, NotBegun<dim>> begin(const Case& c, const std::filesystem::path& folder,
                                            const PlaneSearch& search);

  /// The run in this folder with this case; starts from the beginning if it was killed before its first
  /// checkpoint. Throws OutputError.
  static Expected<Run, NotBegun<dim>> resume(const Case& c, const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const Study<dim>& study() const { return study_; }
  const Resumption& resumption() const { return resumption_; }

  /// In addition to make_observers(), and notified after them.
  void add(std::unique_ptr<Observer<dim>> observer) { observers_.push_back(std::move(observer)); }

  /// Optimizes until there is a reason to stop, executing commands between the trial shapes. Must be called
  /// only once. Throws OutputError.
  RunResult<dim> execute(CommandQueue& commands, OnEnd on_end = OnEnd::finish);

 private:
  Run(FolderLock lock, std::filesystem::path folder, Study<dim> study, Resumption resumption,
      CheckpointFolder checkpoints, std::optional<Checkpoint<dim>> checkpoint);

  FolderLock lock_;
  std::filesystem::path folder_;
  Study<dim> study_;
  Resumption resumption_;
  std::optional<Checkpoint<dim>> checkpoint_;
  Observers<dim> observers_;
};

}  // namespace wheelwright
