#pragma once

#include "wheelwright/run/expectations.h"
#include "wheelwright/run/run_folder.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/run/history.h"
#include "wheelwright/app/progress.h"

namespace wheelwright {

/// Watches the loop: history, progress, pictures and expectations. The loop knows nothing of it.
class RunRecorder {
 public:
  /// Goes on after `start`, if there is one. All but `start` must outlive this.
  RunRecorder(const Case& c, const RollingProblem<2>& problem, const Criteria<2>& criteria, RunFolder& folder,
              const std::optional<Checkpoint<2>>& start);

  void operator()(const Trial<2>& trial, const OptimizationState<2>& state);

  History& history() { return history_; }

  /// A line of text among the progress.
  void note(std::string_view line) { progress_.note(line); }

  /// To be called before anything else is printed.
  void end_progress() { progress_.end(); }

  const ExpectationWatch& expectations() const { return expectations_; }
  const std::optional<InitialShape<2>>& initial() const { return initial_; }
  double elapsed() const { return elapsed_; }
  /// The failed trials since the last accepted shape.
  const std::vector<Trial<2>>& failed() const { return failed_; }

 private:
  void record(const Trial<2>& trial, double seconds);

  const Case& case_;
  const RollingProblem<2>& problem_;
  RunFolder& folder_;
  History history_;
  ExpectationWatch expectations_;
  Progress progress_;
  Stopwatch watch_;
  double elapsed_ = 0;
  std::optional<InitialShape<2>> initial_;
  std::vector<Trial<2>> failed_;
};

}  // namespace wheelwright
