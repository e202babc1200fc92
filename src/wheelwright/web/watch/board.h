#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/optimizer/optimizer.h"

namespace wheelwright {

/// A shape of a run with its solutions, for display. Immutable.
template <int dim>
struct WatchedShape {
  std::shared_ptr<const Case> source;
  std::shared_ptr<const StateSolver<dim>> solver;  ///< required by the solutions
  std::shared_ptr<const LoadCases<dim>> load_cases;
  StatesOfCases<dim> solutions;  ///< one for each load case, and at least one
  LevelSet<dim> psi;
  int number;  ///< of the accepted shape
  double objective;
  std::vector<TermValue> terms;
  std::vector<MeasureValue> measures;
  std::vector<BoundState> bounds;
  double initial_objective;        ///< of the initial shape under the same case
  double measure, target_measure;  ///< of one sector [m^2], or [m^3] when dim = 3
};

/// The values kept of every shape, for curves.
struct HistoryPoint {
  long version;  ///< of the board when the shape arrived
  int shape;
  double objective, mean_travel, run_out, volume_fraction;  ///< SI units
  /// Of the initial shape: objectives can be compared where it is the same, not across a new load, new
  /// weights or another grid.
  double initial_objective;
};

enum class Activity { starting, computing, paused, settled, ended };
constexpr const char* to_string(Activity activity) {
  constexpr std::array<const char*, 5> words{"starting", "computing", "paused", "settled", "ended"};
  return words[static_cast<std::size_t>(activity)];
}

/// The current state of a run.
template <int dim>
struct BoardView {
  long version = 0;        ///< incremented with every change
  long shape_version = 0;  ///< the version with which the shape arrived
  std::shared_ptr<const WatchedShape<dim>> shape, first;
  std::shared_ptr<const LevelSet<dim>> proposed;  ///< drawn by a command and not solved yet; usually null
  Activity activity = Activity::starting;
  std::optional<StopReason> reason;  ///< why it settled or ended
  bool can_undo = false;
  std::string message;  ///< what the last command did
  bool is_refusal = false;
};

/// The newest state of a run for those who display it. A new shape replaces the one before it, whether or not
/// anyone has seen that. Thread-safe.
template <int dim>
class Board {
 public:
  /// Changes the view.
  template <class Change>
  void update(Change change) {
    {
      const std::scoped_lock lock(mutex_);
      change(view_);
      ++view_.version;
    }
    changed_.notify_all();
  }

  /// The same for a new shape, whose numbers become points of the curves.
  void show(std::shared_ptr<const WatchedShape<dim>> shape);

  BoardView<dim> view() const;

  /// Waits until the version exceeds the given one, this time has passed or the board is closed, and returns
  /// the view.
  BoardView<dim> view_after(long version, std::chrono::milliseconds patience) const;

  /// The points of the curves that came after a version, oldest first.
  std::vector<HistoryPoint> curve_after(long version) const;

  /// Wakes all waiting callers.
  void close();

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  BoardView<dim> view_;
  std::deque<HistoryPoint> curve_;
  bool is_closed_ = false;
};

}  // namespace wheelwright
