#pragma once

#include <memory>

#include "wheelwright/run/commands/stop_file.h"
#include "wheelwright/run/session/journal.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/run/session/schedule.h"
#include "wheelwright/run/session/session_control.h"

namespace wheelwright {

/// The loop of a run: searches for better shapes, between which it obeys commands; at the end of each search
/// the schedule decides what follows. What Run::execute() does.
template <int dim>
class RunLoop {
 public:
  /// All arguments except the study, which a command may replace, must outlive this.
  RunLoop(const std::filesystem::path& folder, Study<dim> study, const Observers<dim>& observers,
          CommandQueue& commands, OnEnd on_end);

  /// From the initial shape, or from a checkpoint, to the end. Throws OutputError.
  RunResult<dim> begin();
  RunResult<dim> resume(const Checkpoint<dim>& checkpoint);

 private:
  std::optional<Failure> start();
  void show_resumed_shape();
  RunResult<dim> run();
  std::optional<StopReason> advance();
  void record(const Trial<dim>& trial);
  RunResult<dim> give_up(const Failure& failure);
  RunResult<dim> end(StopReason reason);

  Interrupt at_stop(Interrupt::Progress progress);
  Interrupt at_later_stop();
  Interrupt::Progress progress_of_shape();
  Interrupt::Progress progress_of_results();

  const std::filesystem::path& folder_;
  CommandQueue& commands_;
  OnEnd on_end_;
  std::shared_ptr<StopFile> stop_file_;
  Session<dim> session_;
  Journal<dim> journal_;
  Schedule<dim> schedule_;
  SessionControl<dim> control_;
};

}  // namespace wheelwright
