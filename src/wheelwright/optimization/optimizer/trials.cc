#include "wheelwright/optimization/optimizer/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <class Points>
double boundary_measure(const Points& points) {
  double sum = 0;
  for (const auto& point : points) sum += point.weight;
  return sum;
}

template <int dim>
bool is_finite(const Evaluation<dim>& evaluation) {
  double sum = 0;
  for (const FunctionValue& function : evaluation.functions) {
    sum += function.value;
    for (size_t q = 0; q < evaluation.boundary.size(); ++q)
      sum += evaluation.boundary[q].weight * function.gradient[q];
  }
  return std::isfinite(sum);
}

template <int dim>
double merit_of(const Evaluation<dim>& evaluation, const std::string& objective,
                std::vector<double> penalties) {
  const auto constraints = bound_constraints(evaluation);
  const double value = evaluation.function(objective).value;
  if (penalties.size() != constraints.size()) penalties.assign(constraints.size(), std::abs(value));
  return merit(value, constraints, penalties);
}

/// A change of the objective is a jump if it exceeds this multiple of what the gradient predicts and also
/// this factor: near a minimum the gradient predicts nothing.
constexpr double largest_surprise = 3, largest_factor = 4;

std::optional<Failure> check_jump(double before, double after, double predicted) {
  const auto [small, large] = std::minmax({std::abs(before), std::abs(after)});
  if (std::abs(after - before) <= largest_surprise * std::abs(predicted) || large <= largest_factor * small)
    return {};
  return Failure{FailureReason::objective_jumped,
                 fmt::format("the objective changed from {:.6g} to {:.6g}, but its gradient predicted {:.6g}",
                             before, after, before + predicted)};
}

/// The grid whose design lines have moved.
template <int dim>
PolarGrid<dim> grid_after(PolarGrid<dim> grid, const OptimizerOptions& options, const Move<dim>& move) {
  for (std::size_t k = 0; k < move.radii.size(); ++k)
    grid = with_fixed_line_at(std::move(grid), options.design_lines[k].line, move.radii[k]);
  return grid;
}

/// The trial of an unmoved shape.
template <int dim>
Trial<dim> unmoved(int iteration, LevelSet<dim> shape) {
  return {.iteration = iteration,
          .halvings = 0,
          .step = 0,
          .max_velocity = 0,
          .evolution_seconds = 0,
          .shape = std::move(shape),
          .measure = unknown,
          .verdict = Verdict::failed};
}

}  // namespace

/// Quadratic steps require shapes whose motion can be predicted.
EvolutionOptions in_space_of(Method method, EvolutionOptions evolution) {
  evolution.space = method == Method::sequential_quadratic ? ShapeSpace::spline : ShapeSpace::nodal;
  return evolution;
}

template <int dim>
Trials<dim>::Trials(const Lattice<dim>& lattice, const EvolutionOptions& evolution,
                    const OptimizerOptions& options, EvaluateShape<dim> evaluate)
    : grid_(lattice.grid()),
      evolver_(std::make_shared<const Evolver<dim>>(lattice, in_space_of(options.method, evolution))),
      whole_(sector_measure<dim>(lattice.grid())),
      options_(options),
      evaluate_(std::move(evaluate)) {}

template <int dim>
Trials<dim>::Trials(const PolarGrid<dim>& grid, Setting<dim> setting, const OptimizerOptions& options,
                    SettingOn<dim> setting_on)
    : grid_(grid),
      evolver_(std::move(setting.evolver)),
      setting_on_(std::move(setting_on)),
      whole_(sector_measure<dim>(grid)),
      options_(options),
      evaluate_(std::move(setting.evaluate)) {}

template <int dim>
Expected<Trials<dim>> Trials<dim>::on(const PolarGrid<dim>& grid) const {
  if (is_on(grid)) return *this;
  auto setting = setting_on_(grid);
  if (!setting) return setting.failure();
  return Trials(grid, *std::move(setting), options_, setting_on_);
}

template <int dim>
std::shared_ptr<const Evolver<dim>> Trials<dim>::evolver_of(const PolarGrid<dim>& grid) const {
  if (is_on(grid)) return evolver_;
  const auto there = on(grid);
  return there ? there->evolver_ : evolver_;
}

template <int dim>
Trials<dim> Trials<dim>::with(EvaluateShape<dim> evaluate) const {
  Trials other = *this;
  other.evaluate_ = std::move(evaluate);
  return other;
}

template <int dim>
Trial<dim> Trials<dim>::first(const LevelSet<dim>& given) const {
  Trial<dim> trial = unmoved<dim>(0, evolver_->keep_bands(given));
  const double measure = material_measure(trial.shape);
  const auto target = is_in_reach(measure) ? options_.target_measure : std::nullopt;
  const double boundary = boundary_measure(boundary_samples<dim>(trial.shape));
  evaluate(finished_shape(*evolver_, trial.shape, requirements(target, boundary, evolver_->features())),
           nullptr, trial);
  if (trial.failure) {
    if (target) name_target(measure, *target, *target, *trial.failure);
    return trial;
  }
  trial.verdict = Verdict::accepted;
  add_changes(given, trial);
  return trial;
}

template <int dim>
Trial<dim> Trials<dim>::again(const OptimizationState<dim>& state) const {
  Trial<dim> trial = unmoved<dim>(state.iteration, state.shape);
  evaluate(measured_shape(*evolver_, state.shape, evolver_->features()), nullptr, trial);
  if (!trial.failure) trial.verdict = Verdict::accepted;
  return trial;
}

template <int dim>
Trial<dim> Trials<dim>::moved(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                              const Move<dim>& move, int halvings) const {
  Trial<dim> trial = without_shape(state, halvings, move.step, {});
  trial.max_velocity = largest_magnitude(move.velocity);
  trial.predicted = move.model_decrease;
  const PolarGrid<dim> grid = grid_after(state.shape.lattice.grid(), options_, move);
  if (is_on(grid)) {
    evaluate_moved(state, move, halvings == 0, trial);
  } else if (const auto there = on(grid)) {
    there->evaluate_moved(state, move, halvings == 0, trial);
  } else {
    trial.failure = there.failure();
  }
  if (!trial.failure)
    trial.failure =
        check_jump(objective_of(state.evaluation), objective_of(*trial.evaluation), move.objective_change);
  if (trial.failure) {
    name_target(state.measure, move.measure, state.target_measure, *trial.failure);
    return trial;
  }
  trial.verdict = proposals.accepts(move, *trial.evaluation) ? Verdict::accepted : Verdict::objective_rose;
  if (trial.verdict == Verdict::accepted) add_changes(state.shape, trial);
  return trial;
}

/// Gives the trial the state's shape after the move, on the own grid, and evaluates it.
template <int dim>
void Trials<dim>::evaluate_moved(const OptimizationState<dim>& state, const Move<dim>& move, bool is_reshaped,
                                 Trial<dim>& trial) const {
  const Stopwatch watch;
  auto shape = moved_shape(state, move, is_reshaped);
  trial.evolution_seconds = watch.seconds();
  evaluate(std::move(shape), &state.evaluation, trial);
}

/// The state's shape after the move, on the own grid, with whose lines it moves.
template <int dim>
ShapeResult<dim> Trials<dim>::moved_shape(const OptimizationState<dim>& state, const Move<dim>& move,
                                          bool is_reshaped) const {
  const PolarGrid<dim>& before = state.shape.lattice.grid();
  const ShapeMotion motion{
      .velocity = move.velocity,
      .distance = move.distance * before.resolution(),
      .redistances = is_reshaped && is_due(options_.redistance_every, state.since_redistance),
      .smooths = is_reshaped && is_due(options_.smooth_every, state.since_smoothing)};
  const auto required =
      requirements(move.measure, boundary_measure(state.evaluation.boundary), widths_after(state));
  if (before == grid_) return next_shape(*evolver_, state.shape, motion, required);
  LevelSet<dim> psi = state.shape;
  if (motion.distance > 0) {
    const auto here = on(before);
    auto moved = here ? here->evolver().move(psi, motion.velocity, motion.distance)
                      : Expected<LevelSet<dim>>(here.failure());
    if (!moved) return UnfinishedShape<dim>{psi, unknown, {}, moved.failure()};
    psi = *std::move(moved);
  }
  psi.lattice = Lattice<dim>(grid_, psi.lattice.degree());
  return reshaped(*evolver_, evolver_->keep_bands(psi), motion.redistances, motion.smooths, required);
}

template <int dim>
Trial<dim> Trials<dim>::at_rest(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                                Move<dim> move, int halvings) const {
  move.distance = 0;
  move.radii.clear();
  move.step = 0;
  move.measure = state.measure;
  move.objective_change = 0;
  move.model_decrease = 0;
  Trial<dim> trial = moved(state, proposals, move, halvings);
  if (trial.failure)
    trial.failure->detail += "; it fails even if the boundary does not move, so no smaller step helps";
  return trial;
}

template <int dim>
std::vector<Trial<dim>> Trials<dim>::repaired(const OptimizationState<dim>& state) const {
  const FeatureSize widths = widths_after(state);
  std::vector<Trial<dim>> trials{repaired(state, state.shape)};
  const LevelSet<dim> cut = without_thin_walls(state.shape, widths.wall);
  if (cut.values != state.shape.values) trials.push_back(repaired(state, cut));
  const auto merit_or_worst = [&](const Trial<dim>& trial) {
    return trial.failure ? std::numeric_limits<double>::infinity()
                         : merit_of(*trial.evaluation, options_.objective, state.memory.penalties);
  };
  std::ranges::stable_sort(trials, std::greater<>(), merit_or_worst);
  for (std::size_t k = 0; k < trials.size(); ++k) trials[k].halvings = static_cast<int>(k);
  Trial<dim>& best = trials.back();
  if (best.failure) return trials;
  best.verdict = Verdict::accepted;
  for (const auto& event : narrowest_places(state.shape, widths)) best.events.push_back(event);
  add_changes(state.shape, best);
  return trials;
}

/// The trial of a shape with the widths of the shapes after the state.
template <int dim>
Trial<dim> Trials<dim>::repaired(const OptimizationState<dim>& state, const LevelSet<dim>& shape) const {
  const Stopwatch watch;
  Trial<dim> trial = unmoved<dim>(state.iteration + 1, evolver_->in_space(shape));
  auto finished = finished_shape(
      *evolver_, trial.shape,
      requirements(state.target_measure, boundary_measure(state.evaluation.boundary), widths_after(state)));
  trial.evolution_seconds = watch.seconds();
  if (finished && has_holes(state.shape) && !has_holes(finished->shape)) {
    trial.failure = {FailureReason::too_narrow, "the minimum widths fill all holes"};
    return trial;
  }
  evaluate(std::move(finished), &state.evaluation, trial);
  if (!trial.failure) trial.verdict = Verdict::objective_rose;
  return trial;
}

template <int dim>
Trial<dim> Trials<dim>::without_shape(const OptimizationState<dim>& state, int halvings, double step,
                                      const std::optional<Failure>& failure) const {
  return {.iteration = state.iteration + 1,
          .halvings = halvings,
          .step = step,
          .max_velocity = unknown,
          .evolution_seconds = 0,
          .shape = state.shape,
          .measure = unknown,
          .verdict = Verdict::failed,
          .failure = failure};
}

template <int dim>
ShapeRequirements Trials<dim>::requirements(std::optional<double> measure, double boundary_measure,
                                            const FeatureSize& widths) const {
  const bool is_exact = options_.measure_control == MeasureControl::exact;
  return {.measure = is_exact ? measure : std::nullopt,
          .boundary_measure = boundary_measure,
          .widths = widths,
          .largest_island = options_.largest_island * whole_};
}

/// Gives the trial its shape, as far as it could be made, and evaluates it.
template <int dim>
void Trials<dim>::evaluate(ShapeResult<dim> shape, const Evaluation<dim>* previous, Trial<dim>& trial) const {
  if (!shape) {
    const UnfinishedShape<dim>& last = shape.failure();
    trial.shape = last.shape;
    trial.measure = last.measure;
    trial.events = last.removed;
    trial.failure = last.failure;
    return;
  }
  trial.shape = std::move(shape->shape);
  trial.measure = shape->measure;
  trial.events = std::move(shape->removed);
  auto evaluated = evaluate_({trial.shape, &shape->domain}, previous);
  if (!evaluated) {
    trial.failure = evaluated.failure();
    return;
  }
  trial.solution = std::move(evaluated->state);
  trial.other_solutions = std::move(evaluated->others);
  if (is_finite(evaluated->evaluation))
    trial.evaluation = std::move(evaluated->evaluation);
  else
    trial.failure = Failure{FailureReason::not_finite, "the objective or its shape gradient"};
}

template <int dim>
void Trials<dim>::add_changes(const LevelSet<dim>& before, Trial<dim>& trial) const {
  for (const auto& event : evolver_->changes(before, trial.shape)) trial.events.push_back(event);
}

template <int dim>
FeatureSize Trials<dim>::widths_after(const OptimizationState<dim>& state) const {
  return wheelwright::widths_after(evolver_->features(), options_, state);
}

template <int dim>
double Trials<dim>::objective_of(const Evaluation<dim>& evaluation) const {
  return evaluation.function(options_.objective).value;
}

/// Whether one full step brings this measure to the given target.
template <int dim>
bool Trials<dim>::is_in_reach(double measure) const {
  return options_.target_measure &&
         std::abs(*options_.target_measure - measure) <= options_.measure_rate * whole_;
}

/// Adds to the failure of a trial that its measure was to change, if it was [m^2, or m^3 when dim = 3].
template <int dim>
void Trials<dim>::name_target(double from, double to, double target, Failure& failure) const {
  if (options_.measure_control != MeasureControl::exact || failure.reason == FailureReason::interrupted ||
      std::abs(to - from) <= measure_tolerance * target)
    return;
  failure.detail += fmt::format(
      "; the volume was to change from {:.6g} to {:.6g} of the ring, on its way to volume.target = {:.6g}: "
      "choose a target closer to these, or a smaller volume.rate",
      from / whole_, to / whole_, target / whole_);
}

template class Trials<2>;
template class Trials<3>;

}  // namespace wheelwright
