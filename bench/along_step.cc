/// How smooth the objective and the bounds are along a step: runs a case for SHAPES accepted shapes, takes
/// the move that the method proposes next, and evaluates the shape after parts of it that move the boundary
/// by 1e-4 to 1 cell, with the volume and the widths of the run, but without redistancing. Both maps from a
/// deformation to a shape are compared: the one of sequential quadratic steps, whose design is the
/// coefficients of a spline, and that of optimizer.method = "descent", whose design is the values at the
/// nodes. Prints the change of each quantity, relative to its value or its bound, at the shortest step, at a
/// hundredth of a cell and at the longest step, and its largest jump: the distance from the cubic polynomial
/// through the four nearest steps, of steps up to a tenth of a cell. Writes the picture SVG of the changes.
/// usage: along_step CASE SHAPES SVG [KEY=NUMBER ...]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "given_case.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/optimizer/proposals.h"
#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::bench {
namespace {

constexpr int steps_per_decade = 8, decades = 4;

/// The changes of a quantity after parts of a move.
struct AlongStep {
  std::string name;
  std::vector<double> changes;  ///< at the lengths; NaN: there is no such shape
};

/// By how far the parts of the move displace the boundary at most [cells].
std::vector<double> lengths() {
  std::vector<double> result;
  for (int k = 0; k <= steps_per_decade * decades; ++k)
    result.push_back(std::pow(10, static_cast<double>(k) / steps_per_decade - decades));
  return result;
}

/// The state after this number of accepted shapes, or the last one before the run ends.
template <int dim>
Expected<OptimizationState<dim>> state_after(const ShapeOptimizer<dim>& optimizer,
                                             const LevelSet<dim>& initial, int shapes) {
  const auto observe = [](const Trial<dim>&, const OptimizationState<dim>&) {};
  auto state = optimizer.start(initial, observe);
  while (state && state->iteration < shapes && !optimizer.advance(*state, observe, [] { return false; })) {
  }
  return state;
}

/// The objective, relative to that of the state, and how far the bounds are violated, relative to them.
template <int dim>
std::vector<double> quantities(const Evaluation<dim>& evaluation, const Evaluation<dim>& of_state) {
  std::vector<double> result{evaluation.function("objective").value / of_state.function("objective").value};
  for (const auto& bound : bound_constraints(evaluation)) result.push_back(bound.gap);
  return result;
}

/// The quantities along a move, in a space of shapes.
template <int dim>
std::vector<AlongStep> along(const Study<dim>& study, ShapeSpace space, const OptimizationState<dim>& state,
                             const Move<dim>& move) {
  EvolutionOptions evolution = study.evolution;
  evolution.space = space;
  const Evolver<dim> evolver(state.shape.lattice, evolution);
  const auto evaluate = evaluate_of(study);
  const bool keeps_measure = study.optimizer.measure_control == MeasureControl::exact;
  double length_of_boundary = 0;
  for (const auto& point : state.evaluation.boundary) length_of_boundary += point.weight;
  const ShapeRequirements required{.measure = keeps_measure ? std::optional(state.measure) : std::nullopt,
                                   .boundary_measure = length_of_boundary,
                                   .widths = widths_after(evolver.features(), study.optimizer, state),
                                   .largest_island = 0.01 * state.measure};
  const auto before = quantities(state.evaluation, state.evaluation);
  std::vector<AlongStep> result{{"objective", {}}};
  for (const auto& bound : bound_constraints(state.evaluation))
    result.push_back({state.evaluation.functions[bound.function].name, {}});
  for (const double length : lengths()) {
    const double distance = length * move.distance / move.step * state.shape.lattice.grid().resolution();
    const auto shape =
        next_shape(evolver, state.shape, {.velocity = move.velocity, .distance = distance}, required);
    const auto evaluated = shape ? evaluate({shape->shape, &shape->domain}, &state.evaluation)
                                 : Expected<Evaluated<dim>>(shape.failure().failure);
    const auto values = evaluated ? quantities(evaluated->evaluation, state.evaluation)
                                  : std::vector<double>(result.size(), NAN);
    for (std::size_t k = 0; k < result.size(); ++k) result[k].changes.push_back(values[k] - before[k]);
  }
  return result;
}

/// The value at x of the cubic polynomial through four points.
double cubic_through(const std::vector<double>& x, const std::vector<double>& y, double at) {
  double sum = 0;
  for (std::size_t a = 0; a < x.size(); ++a) {
    double term = y[a];
    for (std::size_t b = 0; b < x.size(); ++b)
      if (b != a) term *= (at - x[b]) / (x[a] - x[b]);
    sum += term;
  }
  return sum;
}

double largest_jump(const AlongStep& q) {
  constexpr double longest = 0.1;
  const auto t = lengths();
  double jump = 0;
  for (std::size_t k = 2; k + 2 < t.size() && t[k + 2] <= longest; ++k) {
    const double expected =
        cubic_through({t[k - 2], t[k - 1], t[k + 1], t[k + 2]},
                      {q.changes[k - 2], q.changes[k - 1], q.changes[k + 1], q.changes[k + 2]}, t[k]);
    jump = std::max(jump, std::abs(q.changes[k] - expected));
  }
  return jump;
}

PlotCurve curve(const std::string& label, const AlongStep& q) {
  PlotCurve result{label, {}, q.changes};
  for (const double length : lengths()) result.x.push_back(std::log10(length));
  for (double& y : result.y) y *= 100;
  return result;
}

template <int dim>
int run(const Case& c, int shapes, const std::string& picture) {
  const auto study = make_study<dim>(c);
  if (!study) {
    fmt::print(stderr, "{}\n", study.failure().detail);
    return 1;
  }
  const auto optimizer = optimizer_of(*study);
  const auto state = state_after(optimizer, study->initial, shapes);
  const auto proposals = state ? proposals_from(optimizer.evolver(), study->optimizer, *state)
                               : Expected<std::unique_ptr<Proposals<dim>>>(state.failure());
  const auto move = proposals ? (*proposals)->move(state->step) : Expected<Move<dim>>(proposals.failure());
  if (!move) {
    fmt::print(stderr, "{}\n", move.failure().detail);
    return 1;
  }
  LinePlot plot{fmt::format("{}, after {} shapes", c.title, state->iteration),
                {"logarithm of the step", "cells"},
                {"change", "%"},
                {}};
  fmt::print("{:>8} {:>20} {:>14} {:>14} {:>14} {:>14}\n", "map", "change of", "1e-4 cells", "0.01 cells",
             "1 cell", "largest jump");
  for (const auto& [space, name] : {std::pair{ShapeSpace::spline, "spline"}, {ShapeSpace::nodal, "nodes"}})
    for (const auto& q : along(*study, space, *state, *move)) {
      fmt::print("{:>8} {:>20} {:14.2e} {:14.2e} {:14.2e} {:14.1e}\n", name, q.name, q.changes.front(),
                 q.changes[decades / 2 * steps_per_decade], q.changes.back(), largest_jump(q));
      plot.curves.push_back(curve(fmt::format("{}, {}", q.name == "objective" ? "J" : "bound", name), q));
    }
  std::ofstream(picture) << plot_svg(plot);
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  if (count < 4) {
    fmt::print(stderr, "usage: {} CASE SHAPES SVG [KEY=NUMBER ...]\n", arguments[0]);
    return 2;
  }
  const wheelwright::ThreadLimit one_thread(1);
  const auto c = wheelwright::bench::given_case(arguments[1], {arguments + 4, arguments + count});
  if (!c) return 2;
  return in_dimension_of(
      *c, [&](auto dim) { return wheelwright::bench::run<dim>(*c, std::atoi(arguments[2]), arguments[3]); });
}
