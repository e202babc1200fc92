#pragma once

#include <deque>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/final_results.h"
#include "wheelwright/run/run.h"
#include "wheelwright/run/stop_file.h"

namespace wheelwright {

/// The loop of a run with its observers and commands: what Run::execute() does.
template <int dim>
class RunLoop : private RunControl {
 public:
  /// All arguments except the study, which a command may replace, must outlive this.
  RunLoop(const std::filesystem::path& folder, Study<dim> study, const Observers<dim>& observers,
          CommandQueue& commands, OnEnd on_end);

  /// From the initial shape, or from a checkpoint, to the end. Throws OutputError.
  RunResult<dim> begin();
  RunResult<dim> resume(const Checkpoint<dim>& checkpoint);

 private:
  /// The objects the loop works on. A change of the case replaces all of them.
  struct Work {
    Study<dim> study;
    typename ShapeOptimizer<dim>::Evaluate evaluate;
    ShapeOptimizer<dim> optimizer;
  };
  std::shared_ptr<const Work> make_work(Study<dim> study);
  Interrupt::Progress contact_progress();

  // RunControl
  const Case& current_case() const override { return work_->study.source; }
  int iteration() const override { return state_->iteration; }
  void save() override { notify(SaveRequested<dim>{*state_}); }
  void stop() override { is_stopped_ = true; }
  void pause(int after_shapes) override;
  void continue_run() override;
  std::optional<Refusal> change_case(const Case& changed, const std::string& what) override;
  std::vector<Point> hole_at(const Point& point) const override;
  std::optional<Refusal> draw(std::span<const Stroke> strokes, const std::string& what) override;
  std::optional<Refusal> take_shape(const std::filesystem::path& file, const std::string& what) override;
  std::optional<Refusal> reset() override;
  Expected<std::string, Refusal> undo() override;

  /// The state restored by a command to undo.
  struct Past {
    Case source;
    LevelSet<dim> shape;
    std::string change;  ///< readable description of the change that followed
  };
  Past before(const std::string& change) const { return {work_->study.source, state_->shape, change}; }
  void remember(Past past);
  void restart_search();
  std::optional<Refusal> work_on(const Case& changed, const LevelSet<dim>& shape, const std::string& what);
  std::optional<Refusal> replace_shape(const LevelSet<dim>& shape, const std::string& what);
  Expected<OptimizationState<dim>> state_at(const ShapeOptimizer<dim>& optimizer, const LevelSet<dim>& shape,
                                            std::optional<Trial<dim>>& trial) const;

  RunResult<dim> advance();
  bool nucleates(StopReason reason);
  bool makes_holes();
  bool undo_nucleation(StopReason reason);
  bool continues_after(const Failure& failure);
  bool begins_on_coarser_grid() const;
  void begin_on_coarser_grid();
  std::optional<Failure> move_to_grid(int level);
  RunResult<dim> end(StopReason reason);
  RunResult<dim> end_without_a_shape(const Failure& failure);
  RunResult<dim> end_between_grids(const Failure& failure);
  std::vector<Finding> findings_at_the_end(const SolvedStates<dim>& solution);
  RunResult<dim> result(StopReason reason) const;

  void observe(const Trial<dim>& trial, const OptimizationState<dim>& state);
  bool must_yield();
  void execute(const Command& command);
  bool is_paused() const;
  void wait_while_paused();
  void wait_for_more(StopReason reason);
  void notify(const Event<dim>& event);
  void write_case_file() const;

  const std::filesystem::path& folder_;
  const Observers<dim>& observers_;
  CommandQueue& commands_;
  OnEnd on_end_;
  std::shared_ptr<StopFile> stop_file_;
  int stops_before_ =
      0;  ///< commands to stop that were waiting when the run started: they let the first shape finish

  std::shared_ptr<const Work> work_;
  std::optional<OptimizationState<dim>> state_;
  std::optional<InitialShape<dim>> initial_;
  SolvedShapes<dim> solved_;  ///< the last one is kept only at the end
  Nucleation<dim> nucleation_;
  std::vector<Trial<dim>> failed_trials_;
  std::deque<Past> past_;  ///< newest last

  bool is_stopped_ = false;
  std::optional<int> pause_at_;       ///< number of the shape after which the run waits
  int changes_ = 0;                   ///< of case or shape by commands, so far
  bool has_ended_by_itself_ = false;  ///< and waits for commands
  Stopwatch watch_;
  Stopwatch sign_of_life_;  ///< since the last shape or progress notice
  double elapsed_ = 0;
};

}  // namespace wheelwright
