#include "wheelwright/run/session/session.h"

#include "wheelwright/case/design_radii.h"
#include "wheelwright/run/session/replacements.h"
#include "wheelwright/run/study/on_other_grid.h"
#include "wheelwright/shape/evolution/regrid.h"

namespace wheelwright {
namespace {

template <int dim>
struct Restarted {
  OptimizationState<dim> state;
  Trial<dim> trial;
};

template <int dim>
Expected<Restarted<dim>> restarted(const ShapeOptimizer<dim>& optimizer,
                                   const OptimizationState<dim>& state) {
  std::optional<Trial<dim>> trial;
  auto again =
      optimizer.restart(state, [&](const Trial<dim>& seen, const OptimizationState<dim>&) { trial = seen; });
  if (!again) return again.failure();
  return Restarted<dim>{*std::move(again), *std::move(trial)};
}

/// The state with another shape, which may be on another grid of the same wheel.
template <int dim>
OptimizationState<dim> with_shape(OptimizationState<dim> state, const LevelSet<dim>& shape) {
  state.shape = regrid(shape, state.shape.lattice);
  return state;
}

}  // namespace

template <int dim>
Session<dim>::Session(Study<dim> study, Interrupt on_stop, Interrupt completed)
    : on_stop_(std::move(on_stop)), completed_(std::move(completed)), bench_(make_bench(std::move(study))) {}

template <int dim>
std::shared_ptr<const Workbench<dim>> Session<dim>::make_bench(Study<dim> study) const {
  auto moved = moved_studies(study);
  return make_bench(std::move(study), std::move(moved));
}

template <int dim>
std::shared_ptr<const Workbench<dim>> Session<dim>::make_bench(
    Study<dim> study, std::shared_ptr<MovedStudies<dim>> moved) const {
  auto evaluate = evaluate_of(study, on_stop_);
  ShapeOptimizer<dim> optimizer = optimizer_of(study, moved, on_stop_);
  ShapeOptimizer<dim> uninterrupted =
      moved ? optimizer_of(study, moved, completed_) : optimizer.with(evaluate_of(study, completed_));
  return std::make_shared<const Workbench<dim>>(Workbench<dim>{std::move(study), std::move(evaluate),
                                                               std::move(optimizer), std::move(uninterrupted),
                                                               std::move(moved)});
}

template <int dim>
bool Session<dim>::follow_radii() {
  const PolarGrid<dim>& grid = state_->shape.lattice.grid();
  if (!bench_->moved || grid == bench_->study.grid()) return false;
  const auto there = bench_->moved->on(grid);
  if (!there) return false;
  bench_ = make_bench((*there)->study, bench_->moved);
  return true;
}

template <int dim>
void Session<dim>::begin(OptimizationState<dim> first) {
  initial_ = InitialShape<dim>{first.shape, bench_->optimizer.objective_of(first.evaluation), first.measure};
  state_ = std::move(first);
}

template <int dim>
void Session<dim>::resume(const Checkpoint<dim>& checkpoint) {
  state_ = checkpoint.state;
  initial_ = checkpoint.initial;
  nucleation_ = checkpoint.nucleation;
}

template <int dim>
void Session<dim>::enter(Stage<dim> stage) {
  bench_ = std::move(stage.bench);
  state_ = std::move(stage.state);
  initial_ = std::move(stage.initial);
  nucleation_ = std::move(stage.nucleation);
}

template <int dim>
NextStage<dim> Session<dim>::at(const LevelSet<dim>& shape, const ShapeOptimizer<dim>& optimizer) const {
  auto there = restarted(optimizer, with_shape(*state_, shape));
  if (!there) return there.failure();
  InitialShape<dim> initial = *initial_;
  return Stage<dim>{bench_, std::move(there->state), std::move(initial), {}, std::move(there->trial)};
}

template <int dim>
Expected<Stage<dim>, Refusal> Session<dim>::under(const Case& c, const LevelSet<dim>& shape) const {
  const int level = study().level;
  if (level_of(c, initial_->shape) != 0 || level_of(c, state_->shape) != level)
    return Refusal{"the shape is on another grid than the case's"};
  auto study = make_study<dim>(*with_radii_of(c, state_->shape.lattice.grid(), level), level);
  if (!study) return refusal(study.failure());
  const Case at_first = *with_radii_of(c, initial_->shape.lattice.grid());
  const auto of_initial = level == 0 && at_first == study->source ? study : make_study<dim>(at_first);
  if (!of_initial) return refusal(of_initial.failure());
  const auto first = evaluate_of(*of_initial)(initial_->shape, nullptr);
  if (!first) return refusal(first.failure());
  auto bench = make_bench(*std::move(study));
  auto there = restarted(bench->uninterrupted, with_shape(*state_, shape));
  if (!there) return refusal(there.failure());
  InitialShape<dim> initial = *initial_;
  initial.objective = first->evaluation.function("objective").value;
  return Stage<dim>{
      std::move(bench), std::move(there->state), std::move(initial), {}, std::move(there->trial)};
}

template <int dim>
NextStage<dim> Session<dim>::on_grid(int level) const {
  auto study = make_study<dim>(this->study().source, level);
  if (!study) return study.failure();
  auto bench = make_bench(*std::move(study));
  auto moved = on_other_grid(*state_, bench->study.initial.lattice, bench->optimizer.evolver());
  if (!moved) return moved.failure();
  auto there = restarted(bench->optimizer, moved->state);
  if (!there) return there.failure();
  there->trial.events = std::move(moved->events);
  return Stage<dim>{std::move(bench), std::move(there->state), *initial_, nucleation_,
                    std::move(there->trial)};
}

template <int dim>
void Session<dim>::remember(Past<dim> past) {
  constexpr std::size_t most = 100;
  past_.push_back(std::move(past));
  if (past_.size() > most) past_.pop_front();
}

template class Session<2>;
template class Session<3>;

}  // namespace wheelwright
