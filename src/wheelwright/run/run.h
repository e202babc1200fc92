#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "wheelwright/run/checkpoint_folder.h"
#include "wheelwright/run/command_queue.h"
#include "wheelwright/run/expectations.h"
#include "wheelwright/run/folder_lock.h"
#include "wheelwright/run/observer.h"
#include "wheelwright/run/resume_point.h"

namespace wheelwright {

// Why a run did not begin or resume.
struct FolderHoldsARun {};
/// The run would replace files that no run wrote.
struct ForeignFiles {
  std::vector<std::string> names;
};
struct CheckpointsGone {};  ///< its history holds trials, but there is no checkpoint
struct NoUsableCheckpoint {
  std::vector<UnusableCheckpoint> unusable;
};
struct CheckpointMisfit {
  std::string reason;
};
template <int dim>
struct AlreadyFinished {
  Checkpoint<dim> end;
  std::vector<Finding> findings;             ///< for what the case expects
  std::vector<UnusableCheckpoint> unusable;  ///< checkpoints that are newer
};
template <int dim>
using NotBegun = std::variant<FolderInUse, FolderHoldsARun, ForeignFiles, CheckpointsGone, NoUsableCheckpoint,
                              CheckpointMisfit, AlreadyFinished<dim>, Failure>;

/// What a run is resumed from; all empty for one that begins.
struct Resumption {
  std::vector<UnusableCheckpoint> unusable;  ///< checkpoints that are newer
  std::optional<int> shape;                  ///< empty: no checkpoint yet, the run begins
  std::optional<std::string> other_program;  ///< which saved the checkpoint, if it is another one
};

/// What a run does where it has a reason to stop by itself.
enum class AtEnd {
  finish,  ///< writes its results
  wait,    ///< waits for commands; only Stop ends it. Continue and Step look for better shapes once more
};

/// How a run ended.
template <int dim>
struct RunResult {
  StopReason reason;
  std::optional<OptimizationState<dim>> state;  ///< the last accepted shape; empty after a failed start
  std::optional<InitialShape<dim>> initial;
  std::vector<Trial<dim>> failed_trials;   ///< after the last accepted shape
  std::vector<Finding> findings;           ///< for what the case expects; of a run that ended by itself
  std::optional<RunSummary<dim>> summary;  ///< empty after a failed start
  double elapsed_seconds;
  bool is_approaching = false;  ///< whether the volume has not reached its target yet
};

/// One optimization of a case in its folder, from its beginning or from its newest checkpoint to its end. The
/// folder is locked as long as this lives.
template <int dim>
class Run {
 public:
  /// Refuses a folder that holds a run, or something of the user's that the run would replace; it leaves such
  /// a folder as it is. Throws OutputError.
  static Expected<Run, NotBegun<dim>> begin(const Case& c, const std::filesystem::path& folder);

  /// The run in this folder, whose case this is; begins it if it was killed before its first checkpoint.
  /// Throws OutputError.
  static Expected<Run, NotBegun<dim>> resume(const Case& c, const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const Study<dim>& study() const { return study_; }
  const Resumption& resumption() const { return resumption_; }

  /// Besides make_observers(), and told after them.
  void add(std::unique_ptr<Observer<dim>> observer) { observers_.push_back(std::move(observer)); }

  /// Optimizes until there is a reason to stop, obeying commands between the trial shapes. To be called once.
  /// Throws OutputError.
  RunResult<dim> execute(CommandQueue& commands, AtEnd at_end = AtEnd::finish);

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
