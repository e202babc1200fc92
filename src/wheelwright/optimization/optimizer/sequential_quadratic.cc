#include "wheelwright/optimization/optimizer/sequential_quadratic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "wheelwright/linalg/add_scaled.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

using Nodal = std::vector<double>;

Nodal combination(const std::vector<double>& coefficients, const std::vector<Nodal>& vectors) {
  Nodal sum(vectors.front().size(), 0.0);
  for (size_t i = 0; i < vectors.size(); ++i) add_scaled(coefficients[i], vectors[i], sum);
  return sum;
}

double product(const Nodal& load, const Nodal& deformation) {
  return std::inner_product(load.begin(), load.end(), deformation.begin(), 0.0);
}

/// The products of several loads with one deformation, four at a time: four sums do not wait for each other.
std::vector<double> products_of(std::span<const Nodal> loads, const Nodal& deformation) {
  std::vector<double> result;
  size_t first = 0;
  for (; first + 4 <= loads.size(); first += 4) {
    const double *a = loads[first].data(), *b = loads[first + 1].data(), *c = loads[first + 2].data(),
                 *d = loads[first + 3].data();
    double with_a = 0, with_b = 0, with_c = 0, with_d = 0;
    for (size_t k = 0; k < deformation.size(); ++k) {
      with_a += a[k] * deformation[k];
      with_b += b[k] * deformation[k];
      with_c += c[k] * deformation[k];
      with_d += d[k] * deformation[k];
    }
    result.insert(result.end(), {with_a, with_b, with_c, with_d});
  }
  for (; first < loads.size(); ++first) result.push_back(product(loads[first], deformation));
  return result;
}

Nodal scaled(Nodal values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void append(const std::vector<double>& values, double factor, Nodal& load) {
  for (const double value : values) load.push_back(factor * value);
}

/// The derivatives of the measure with respect to the radii of design lines, if there are any. Those of
/// shapes without holes there are exactly zero.
template <int dim>
std::vector<double> measure_by_radius(const Evaluation<dim>& evaluation, const std::string& objective,
                                      const PolarGrid<dim>& grid) {
  if (evaluation.function(objective).by_radius.empty()) return {};
  const FunctionValue& measure = evaluation.function("volume");
  std::vector<double> derivatives = measure.by_radius;
  const double rounding = 1e-9 * measure.value / grid.outer_radius;
  for (double& derivative : derivatives)
    if (std::abs(derivative) < rounding) derivative = 0;
  return derivatives;
}

/// The derivatives of the objective, of the measure, and of the constraints, as loads.
template <int dim>
std::vector<Nodal> loads(const BoundaryMotion<dim>& motion, const LevelSet<dim>& shape,
                         const Evaluation<dim>& evaluation, const std::string& objective,
                         const std::vector<BoundConstraint>& constraints) {
  const auto load_of = [&](const FunctionValue& function, double factor) {
    Nodal load = motion.load(scaled(function.gradient, factor));
    const auto is_zero = [](double density) { return density == 0; };
    if (!std::ranges::all_of(function.edge_gradient, is_zero))
      add_scaled(1, motion.on(shape, evaluation.edges).load(scaled(function.edge_gradient, factor)), load);
    append(function.by_radius, factor, load);
    return load;
  };
  std::vector<Nodal> result{load_of(evaluation.function(objective), 1),
                            motion.load(std::vector<double>(evaluation.boundary.size(), 1.0))};
  append(measure_by_radius(evaluation, objective, shape.lattice.grid()), 1, result.back());
  for (const auto& c : constraints) result.push_back(load_of(evaluation.functions[c.function], 1 / c.scale));
  return result;
}

/// The largest accepted objective is the best one so far, increased by the noise, or the last one if that is
/// larger. Before the final widths, a web thinner than a cell makes the objective jump when it breaks,
/// however small the step: then it may also be the one before the last (the nonmonotone descent of Grippo,
/// Lampariello and Lucidi 1986), which leads past the jump.
template <int dim>
double largest_objective(const OptimizerOptions& options, const OptimizationState<dim>& state, double noise) {
  const auto& history = state.history;
  const double best = std::ranges::min_element(history, {}, &AcceptedShape::objective)->objective,
               largest = std::max(best + noise, history.back().objective);
  const bool may_jump = options.final_widths.any() && state.final_widths == FinalWidths::not_yet;
  return may_jump && history.size() >= 2 ? std::max(largest, history[history.size() - 2].objective) : largest;
}

}  // namespace

template <int dim>
Matrix SequentialQuadraticProposals<dim>::Span::products() const {
  const int n = static_cast<int>(loads.size()), n_known = known.rows(), first_known = n - n_known;
  Matrix result(n, n);
  for (int j = 0; j < n; ++j) {
    const int n_new = std::min(j + 1, first_known);
    const auto products = products_of(std::span<const Nodal>(loads).first(n_new), deformations[j]);
    for (int i = 0; i <= j; ++i)
      result(i, j) = result(j, i) = i < n_new ? products[i] : known(i - first_known, j - first_known);
  }
  return result;
}

template <int dim>
SequentialQuadraticProposals<dim>::SequentialQuadraticProposals(const Evolver<dim>& evolver,
                                                                const OptimizerOptions& options,
                                                                const OptimizationState<dim>& state)
    : evolver_(evolver),
      options_(options),
      state_(state),
      space_(evolver.deformations(), state.shape.lattice.grid(), options.design_lines.size()),
      constraints_(bound_constraints(state.evaluation)),
      widths_(narrow_widths_with_margin(state.shape, widths_after(evolver.features(), options, state),
                                        2 * state.step * state.shape.lattice.grid().resolution())),
      motion_(evolver.deformations().motion_of(state.shape, state.evaluation.boundary)) {
  for (const auto& pair : state_.memory.pairs) pairs_.deformations.push_back(pair.move);
  for (const auto& pair : state_.memory.pairs) pairs_.deformations.push_back(pair.change);
  for (const auto& deformation : pairs_.deformations) pairs_.loads.push_back(space_.load(deformation));
  pairs_.known = pairs_.products();
}

/// The derivatives under this motion, and the pairs.
template <int dim>
typename SequentialQuadraticProposals<dim>::Span SequentialQuadraticProposals<dim>::span_of(
    const BoundaryMotion<dim>& motion) const {
  Span span{.deformations = {},
            .loads = loads(motion, state_.shape, state_.evaluation, options_.objective, constraints_),
            .known = pairs_.known};
  const std::size_t size = span.loads.front().size();
  for (const auto& width : widths_) {
    span.loads.push_back(gap_load(motion, width));
    span.loads.back().resize(size, 0.0);
  }
  for (std::size_t k = 0; k < space_.n_radii(); ++k) span.loads.push_back(space_.unit_load(size, k));
  for (std::size_t k = 0; k < span.loads.size(); ++k) {
    const bool is_known = k < derivatives_.loads.size() && span.loads[k] == derivatives_.loads[k];
    span.deformations.push_back(is_known ? derivatives_.deformations[k]
                                         : space_.representative(span.loads[k]));
  }
  derivatives_ = span;
  span.loads.insert(span.loads.end(), pairs_.loads.begin(), pairs_.loads.end());
  span.deformations.insert(span.deformations.end(), pairs_.deformations.begin(), pairs_.deformations.end());
  return span;
}

/// Holds the coefficients that would move into a band, and lets control points follow those of the layer
/// before that would pass them: repeats the search for the move until no others are added.
template <int dim>
Expected<Move<dim>> SequentialQuadraticProposals<dim>::move(double step,
                                                            const std::vector<double>& bends) const {
  constexpr int max_turns = 5;
  std::vector<bool> held(state_.shape.values.size(), false);
  Following following;
  const double resolution = state_.shape.lattice.grid().resolution();
  const auto limit_more = [&](const Move<dim>& move) {
    const auto& c = motion_.coefficients();
    const double distance = move.distance * resolution;
    const bool holds_more = evolver_.hold_at_bands(c, move.velocity, distance, held);
    return evolver_.follow_as_made(c, move.velocity, distance, following) || holds_more;
  };
  auto move = move_with(held, following, step, bends);
  for (int turn = 0; turn < max_turns && limit_more(move); ++turn)
    move = move_with(held, following, step, bends);
  if (!std::isfinite(move.step)) return Failure{FailureReason::not_finite, "the velocity"};
  return move;
}

template <int dim>
Move<dim> SequentialQuadraticProposals<dim>::move_with(const std::vector<bool>& held,
                                                       const Following& following, double step,
                                                       const std::vector<double>& bends) const {
  const double measure = next_measure(options_, state_, step);
  auto motion = motion_.holding(held);
  if (following.any()) motion = motion.following(state_.shape, state_.evaluation.boundary, following);
  const Span span = span_of(motion);
  auto penalties = this->penalties();
  const auto found = step_in(motion, span, state_.measure - measure, step, bends, penalties);
  auto deformation = combination(found.coefficients, span.deformations);
  auto radii = radii_after(deformation);
  auto velocity = motion.speeds_at_nodes(space_.of_shape(deformation));
  const double resolution = state_.shape.lattice.grid().resolution();
  const double distance = largest_magnitude(velocity) / resolution,
               farthest = largest_magnitude(speeds(motion, deformation));
  const auto of_bounds = found.gaps.end() - static_cast<std::ptrdiff_t>(constraints_.size() + widths_.size() +
                                                                        2 * space_.n_radii());
  return {.velocity = std::move(velocity),
          .deformation = std::move(deformation),
          .radii = std::move(radii),
          .distance = distance,
          .step = farthest / resolution,
          .radius = step,
          .measure = measure,
          .objective_change = found.slope,
          .model_decrease = found.decrease,
          .multipliers = {found.multipliers.begin(),
                          found.multipliers.end() -
                              static_cast<std::ptrdiff_t>(widths_.size() + 2 * space_.n_radii())},
          .penalties = penalties,
          .gaps = {of_bounds, of_bounds + static_cast<std::ptrdiff_t>(constraints_.size())}};
}

/// The speeds of the points of the boundary, then those of the design lines.
template <int dim>
std::vector<double> SequentialQuadraticProposals<dim>::speeds(const BoundaryMotion<dim>& motion,
                                                              std::span<const double> deformation) const {
  auto result = motion.speeds(space_.of_shape(deformation));
  for (const double change : space_.of_radii(deformation)) result.push_back(change);
  return result;
}

/// The radii of the design lines after a deformation, within their bounds. Changes of less than a millionth
/// of a cell are left out of the deformation: another grid would cost more than they gain.
template <int dim>
std::vector<double> SequentialQuadraticProposals<dim>::radii_after(std::vector<double>& deformation) const {
  const PolarGrid<dim>& grid = state_.shape.lattice.grid();
  const double least_change = 1e-6 * grid.resolution();
  std::vector<double> radii;
  for (std::size_t k = 0; k < space_.n_radii(); ++k) {
    const auto& [line, least, most] = options_.design_lines[k];
    double& change = deformation[deformation.size() - space_.n_radii() + k];
    const double now = radius_of_fixed_line(grid, line), next = std::clamp(now + change, least, most);
    change = std::abs(next - now) < least_change ? 0 : next - now;
    radii.push_back(change == 0 ? now : next);
  }
  return radii;
}

/// Raises penalties until the linearized violation decreases by at least half of its possible decrease.
template <int dim>
QuadraticStep SequentialQuadraticProposals<dim>::step_in(const BoundaryMotion<dim>& motion, const Span& span,
                                                         double gap, double step,
                                                         const std::vector<double>& bends,
                                                         std::vector<double>& penalties) const {
  constexpr double raise = 4, beyond = 1e6, enough = 0.5, small = 1e-9, comes_first = 10;
  constexpr int max_raises = 10;
  const int n_pairs = static_cast<int>(state_.memory.pairs.size());
  QuadraticModel model{.products = span.products(),
                       .constraints = {},
                       .first_move = static_cast<int>(span.loads.size()) - 2 * n_pairs,
                       .n_pairs = n_pairs};
  if (options_.measure_control == MeasureControl::exact && model.products(1, 1) > 0)
    model.constraints.push_back({.vector = 1, .sign = 1, .gap = gap, .is_equality = true});
  const size_t first = model.constraints.size();
  for (size_t i = 0; i < constraints_.size(); ++i)
    model.constraints.push_back({.vector = static_cast<int>(2 + i),
                                 .sign = constraints_[i].sign,
                                 .gap = constraints_[i].gap,
                                 .is_equality = constraints_[i].is_equality,
                                 .bend = bends.empty() ? 0 : bends[i]});
  const double of_widths = comes_first * std::abs(state_.evaluation.function(options_.objective).value);
  for (size_t k = 0; k < widths_.size(); ++k)
    model.constraints.push_back({.vector = static_cast<int>(2 + constraints_.size() + k),
                                 .sign = 1,
                                 .gap = widths_[k].gap(),
                                 .is_equality = false,
                                 .penalty = of_widths,
                                 .is_in_merit = false});
  for (std::size_t k = 0; k < space_.n_radii(); ++k) {
    const auto& [line, least, most] = options_.design_lines[k];
    const double radius = radius_of_fixed_line(state_.shape.lattice.grid(), line);
    const int vector = static_cast<int>(2 + constraints_.size() + widths_.size() + k);
    for (const auto& [sign, excess] : {std::pair{1.0, radius - most}, {-1.0, least - radius}})
      model.constraints.push_back(
          {.vector = vector, .sign = sign, .gap = excess, .is_equality = false, .is_in_merit = false});
  }
  std::vector<std::vector<double>> at_boundary;
  for (const auto& deformation : span.deformations) at_boundary.push_back(speeds(motion, deformation));
  const auto with = [&](double factor) {
    for (size_t i = 0; i < penalties.size(); ++i)
      model.constraints[first + i].penalty = factor * penalties[i];
    return trust_region_step(
        model, step * state_.shape.lattice.grid().resolution(),
        [&](const std::vector<double>& d) { return largest_magnitude(combination(d, at_boundary)); });
  };
  const auto total = [&](const QuadraticStep& s) {
    const auto begin = s.violations.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(constraints_.size()), 0.0);
  };
  double now = 0;
  for (const auto& c : constraints_) now += c.violation();
  auto found = with(1);
  if (constraints_.empty() || total(found) <= small) return found;
  const double minimum = total(with(beyond));
  for (int k = 0; k < max_raises && now - total(found) < enough * (now - minimum) - small; ++k) {
    for (size_t i = 0; i < penalties.size(); ++i)
      if (found.violations[first + i] > 0) penalties[i] *= raise;
    found = with(1);
  }
  return found;
}

/// Initially a violation of one percent costs as much as one percent of the objective.
template <int dim>
std::vector<double> SequentialQuadraticProposals<dim>::penalties() const {
  if (state_.memory.penalties.size() == constraints_.size()) return state_.memory.penalties;
  return std::vector<double>(constraints_.size(),
                             std::abs(state_.evaluation.function(options_.objective).value));
}

/// The noise of the objective, from details of the cut cells.
template <int dim>
double SequentialQuadraticProposals<dim>::noise() const {
  return options_.accepted_increase * std::abs(state_.evaluation.function(options_.objective).value);
}

template <int dim>
bool SequentialQuadraticProposals<dim>::accepts(const Move<dim>& move,
                                                const Evaluation<dim>& evaluation) const {
  if (is_approaching(options_, state_)) return true;
  const double objective = evaluation.function(options_.objective).value;
  if (constraints_.empty()) return objective <= largest_objective(options_, state_, noise());
  const double before =
      merit(state_.evaluation.function(options_.objective).value, constraints_, move.penalties);
  return merit(objective, bound_constraints(evaluation), move.penalties) <= before + noise();
}

/// Only if bounds have more than half of the blame: where the objective itself rose, a shorter step is
/// needed.
template <int dim>
std::vector<double> SequentialQuadraticProposals<dim>::bends(const Move<dim>& move,
                                                             const Evaluation<dim>& evaluation) const {
  constexpr double most_of_it = 0.5;
  const auto after = bound_constraints(evaluation);
  std::vector<double> result;
  auto predicted = after;
  for (size_t i = 0; i < after.size(); ++i) {
    predicted[i].gap = move.gaps[i];
    result.push_back(after[i].is_equality ? after[i].gap - move.gaps[i]
                                          : std::max(after[i].gap - move.gaps[i], 0.0));
  }
  const double before =
      merit(state_.evaluation.function(options_.objective).value, constraints_, move.penalties);
  const double shortfall = merit(evaluation.function(options_.objective).value, after, move.penalties) -
                           (before - move.model_decrease);
  const double by_bounds = merit(0, after, move.penalties) - merit(0, predicted, move.penalties);
  if (!(by_bounds > most_of_it * shortfall)) return {};
  return result;
}

template <int dim>
double SequentialQuadraticProposals<dim>::next_step(const Move<dim>& move,
                                                    const Evaluation<dim>& evaluation) const {
  constexpr double poor = 0.25, good = 0.75, shrink = 0.5, grow = 2, near = 0.8;
  const double minimum = std::ldexp(options_.step, -options_.max_halvings);
  const auto merit_of = [&](const Evaluation<dim>& e) {
    return merit(e.function(options_.objective).value, bound_constraints(e), move.penalties);
  };
  const double quality =
      (merit_of(state_.evaluation) - merit_of(evaluation) + noise()) / (move.model_decrease + noise());
  double next = move.radius;
  if (!is_approaching(options_, state_) && quality < poor)
    next = shrink * move.step;
  else if (quality > good && move.step >= near * move.radius)
    next = grow * move.radius;
  return std::clamp(next, minimum, options_.step);
}

/// The pair of the move and the change of the Lagrangian's derivative.
template <int dim>
StepMemory SequentialQuadraticProposals<dim>::remembered(const Move<dim>& move, const LevelSet<dim>& shape,
                                                         const Evaluation<dim>& evaluation,
                                                         const Evolver<dim>& evolver) const {
  StepMemory memory = state_.memory;
  memory.penalties = move.penalties;
  memory.multipliers.assign(move.multipliers.end() - static_cast<std::ptrdiff_t>(constraints_.size()),
                            move.multipliers.end());
  const DesignSpace<dim> space(evolver.deformations(), shape.lattice.grid(), space_.n_radii());
  if (!move.radii.empty())  // another inner product: the loads stay
    for (auto& pair : memory.pairs) pair.change = space.representative(space_.load(pair.change));
  const double unit = 1 / largest_magnitude(move.deformation);
  CurvaturePair pair{.move = move.deformation, .change = {}};
  Nodal change(move.deformation.size(), 0.0);
  for (double& v : pair.move) v *= unit;
  std::vector<double> weights{1.0};
  if (move.multipliers.size() == constraints_.size()) weights.push_back(0);  // the measure is free
  for (const double m : move.multipliers) weights.push_back(m);
  for (size_t i = 0; i < constraints_.size(); ++i) weights[2 + i] *= constraints_[i].sign;
  const auto add_loads = [&](double factor, const BoundaryMotion<dim>& motion, const LevelSet<dim>& psi,
                             const Evaluation<dim>& e) {
    const auto derivatives = loads(motion, psi, e, options_.objective, constraints_);
    for (size_t i = 0; i < derivatives.size(); ++i) add_scaled(factor * weights[i], derivatives[i], change);
  };
  add_loads(unit, evolver.deformations().motion_of(shape, evaluation.boundary), shape, evaluation);
  add_loads(-unit, motion_, state_.shape, state_.evaluation);
  pair.change = space.representative(change);
  const double move_square = product(space.load(pair.move), pair.move),
               move_change = product(change, pair.move), change_square = product(change, pair.change);
  remember(std::move(pair), move_square, move_change, change_square, memory.pairs);
  return memory;
}

template class SequentialQuadraticProposals<2>;
template class SequentialQuadraticProposals<3>;

}  // namespace wheelwright
