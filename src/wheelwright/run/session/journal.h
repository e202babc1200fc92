#pragma once

#include <filesystem>
#include <vector>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/observers/observer.h"
#include "wheelwright/run/results/final_results.h"
#include "wheelwright/run/session/session.h"

namespace wheelwright {

/// Tells the observers of a run what happens, and keeps what its end needs of that: the time of computation,
/// the failed trials and the solutions.
template <int dim>
class Journal {
 public:
  /// The arguments must outlive this.
  Journal(const std::filesystem::path& folder, const Observers<dim>& observers, const Session<dim>& session)
      : folder_(folder), observers_(observers), session_(session) {}

  void notify(const Event<dim>& event) const;

  /// A trial from the session's state; its state has been entered if it was accepted.
  void record(const Trial<dim>& trial);

  /// Reports the progress of slow contact problems, every few seconds.
  void show(const ContactAdvanced& progress);

  void add_seconds(double earlier) { elapsed_ += earlier; }
  void stop_clock() { elapsed_ += watch_.lap(); }
  /// The time since stop_clock() does not count.
  void start_clock() { watch_.lap(); }
  double elapsed_seconds() const { return elapsed_; }

  /// The run gives up because this shape failed at rest.
  void set_failed(int iteration, const LevelSet<dim>& shape, const Failure& failure);
  /// After the last accepted shape.
  const std::vector<Trial<dim>>& failed_trials() const { return failed_trials_; }
  const SolvedShapes<dim>& solved() const { return solved_; }
  const Observers<dim>& observers() const { return observers_; }

  /// The solutions are those of another case.
  void forget_solutions() { solved_ = {}; }

 private:
  void keep(const Trial<dim>& trial);
  void notify(const Event<dim>& event, double elapsed) const;

  const std::filesystem::path& folder_;
  const Observers<dim>& observers_;
  const Session<dim>& session_;
  std::vector<Trial<dim>> failed_trials_;
  SolvedShapes<dim> solved_;  ///< the last one is kept only at the end
  Stopwatch watch_;
  Stopwatch sign_of_life_;  ///< since the last trial or report of progress
  double elapsed_ = 0;
};

/// Continues from a stage. `change` is CaseChanged, ShapeReplaced or GridChanged.
template <int dim>
void enter(Session<dim>& session, Journal<dim>& journal, Stage<dim> stage, const Event<dim>& change);

}  // namespace wheelwright
