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
#include "wheelwright/optimize/constraints.h"
#include "wheelwright/optimize/optimizer.h"
#include "wheelwright/state/load_case.h"

namespace wheelwright {

/// A shape of a run with its solutions, for those who show it. Immutable.
template <int dim>
struct WatchedShape {
  std::shared_ptr<const Case> source;
  std::shared_ptr<const StateSolver<dim>> solver;  ///< which the solutions need
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

/// What is kept of every shape, for curves.
struct CurvePoint {
  long version;  ///< of the board when it came
  int shape;
  double objective, mean_travel, run_out, volume_fraction;  ///< SI units
};

enum class Activity { starting, computing, paused, settled, ended };
constexpr const char* to_string(Activity activity) {
  constexpr std::array<const char*, 5> words{"starting", "computing", "paused", "settled", "ended"};
  return words[static_cast<std::size_t>(activity)];
}

/// What a run looks like now.
template <int dim>
struct BoardView {
  long version = 0;        ///< grows with every change
  long shape_version = 0;  ///< with which the shape came
  std::shared_ptr<const WatchedShape<dim>> shape, first;
  std::shared_ptr<const LevelSet<dim>> proposed;  ///< drawn by a command, and not solved yet; mostly null
  Activity activity = Activity::starting;
  std::optional<StopReason> reason;  ///< why it settled or ended
  bool can_undo = false;
  std::string message;  ///< what the last command did
  bool is_refusal = false;
};

/// Where a run leaves what others show: the newest shape replaces the one before it, whether or not anyone
/// has seen that. Any thread may use it.
template <int dim>
class Board {
 public:
  /// Changes what is to be seen.
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

  /// The view once its version is above the given one, at the latest after this time, or when the board is
  /// closed.
  BoardView<dim> view_after(long version, std::chrono::milliseconds patience) const;

  /// The points of the curves that came after a version, oldest first.
  std::vector<CurvePoint> curve_after(long version) const;

  /// Nobody waits any longer.
  void close();

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  BoardView<dim> view_;
  std::deque<CurvePoint> curve_;
  bool is_closed_ = false;
};

}  // namespace wheelwright
