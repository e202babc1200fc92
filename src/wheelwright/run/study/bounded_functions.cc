#include "wheelwright/run/study/bounded_functions.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

Bounds bounds(const Constraint& c) {
  Bounds result;
  if (c.at_least) result.lower = *c.at_least;
  if (c.at_most) result.upper = *c.at_most;
  if (c.equals) result.lower = result.upper = *c.equals;
  return result;
}

/// The weights of the positions for every separate bound: one position, or the mean of it and its image.
std::vector<std::vector<double>> single_positions(int n, bool are_images_alike) {
  std::vector<std::vector<double>> weights;
  for (int i = 0; i < n; ++i) {
    const int image = are_images_alike ? (n - i) % n : i;
    if (image < i) continue;
    weights.emplace_back(n, 0.0);
    weights.back()[i] += 0.5;
    weights.back()[image] += 0.5;
  }
  return weights;
}

Over positions_of(const Constraint& constraint) {
  if (constraint.quantity->of != Positions::each || constraint.over == OverPositions::mean) return Over::mean;
  if (constraint.over == OverPositions::each) return Over::positions;
  return constraint.at_most ? Over::maximum : Over::minimum;
}

template <int dim>
void add_named(ShapeFunction<dim> function, std::vector<ShapeFunction<dim>>& functions) {
  const std::string name = function.name;
  const auto is_there = [&] {
    return std::ranges::find(functions, function.name, &ShapeFunction<dim>::name) != functions.end();
  };
  for (int k = 2; is_there(); ++k) function.name = fmt::format("{} {}", name, k);
  functions.push_back(std::move(function));
}

/// Adds the functions of a constraint in one load case, named by `in_case`.
template <int dim>
void add_bounded(const Constraint& constraint, const Quantity& bounded, const WeightedFunctional<dim>& term,
                 const std::string& in_case, const StateSolver<dim>& solver, bool are_images_alike,
                 std::vector<ShapeFunction<dim>>& functions) {
  const std::string quantity = name(bounded);
  const Over over = positions_of(constraint);
  const bool is_worst = over == Over::maximum || over == Over::minimum;
  const ShapeFunction<dim> function{.name = (is_worst ? quantity + " worst" : quantity) + in_case,
                                    .terms = {term},
                                    .bounds = bounds(constraint),
                                    .quantity = bounded,
                                    .over = over};
  if (over != Over::positions) {
    add_named(function, functions);
    return;
  }
  int position = 0;
  for (const auto& weights : single_positions(solver.model().n_positions, are_images_alike)) {
    ShapeFunction<dim> at = function;
    at.name = fmt::format("{} at {}{}", quantity, position++, in_case);
    at.position_weights = weights;
    add_named(std::move(at), functions);
  }
}

}  // namespace

template <int dim>
QuantityContext<dim> quantity_context(const Case& c, const StateSolver<dim>& solver) {
  return {.solver = solver,
          .characteristic_length = characteristic_length(c),
          .dual_norm = c.objective.dual_norm};
}

template <int dim>
WeightedSum<dim> in_load_cases(const Case& c, WeightedSum<dim> terms) {
  if (c.load.cases.empty()) return terms;
  WeightedSum<dim> result;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    for (const WeightedFunctional<dim>& term : terms)
      if (const double weight = c.load.cases[k].weight; weight > 0)
        result.push_back({weight * term.weight, term.functional, static_cast<int>(k)});
  return result;
}

Over minimized_over(const Case& c) {
  return c.objective.over == OverPositions::worst ? Over::maximum : Over::mean;
}

template <int dim>
Expected<WeightedSum<dim>> minimized_terms(const Case& c, const StateSolver<dim>& solver) {
  auto only = functional_of(minimized_quantity(c), minimized_over(c), quantity_context(c, solver));
  if (!only) return only.failure();
  WeightedSum<dim> terms{*std::move(only)};
  return c.objective.minimize->of != Positions::none ? in_load_cases(c, std::move(terms)) : std::move(terms);
}

template <int dim>
Expected<std::vector<ShapeFunction<dim>>> bounded_functions(const Case& c, const StateSolver<dim>& solver,
                                                            const LevelSet<dim>& initial) {
  const bool are_images_alike = distinct_positions(solver, load_cases<dim>(c), initial).stand_for_images();
  std::vector<ShapeFunction<dim>> functions;
  for (const Constraint& constraint : c.constraints) {
    const Quantity bounded = quantity_of(c, constraint);
    auto only = functional_of(bounded, positions_of(constraint), quantity_context(c, solver));
    if (!only) return only.failure();
    std::vector<int> cases{0};
    if (bounded->of != Positions::none) cases = load_cases_of(c, constraint);
    for (const int load_case : cases) {
      only->load_case = load_case;
      const std::string in_case = load_case > 0 ? " in " + c.load.cases[load_case].name : "";
      add_bounded(constraint, bounded, *only, in_case, solver, are_images_alike, functions);
    }
  }
  return functions;
}

template <int dim>
std::string text(const BoundState& bound, const PolarGrid<dim>& grid) {
  const char* words = bound.relation == '<' ? "at most" : bound.relation == '>' ? "at least" : "equal to";
  const ShownUnit shown = shown_unit(bound.unit, dim, grid.width);
  const double within = bound.kept_within();
  return fmt::format("{} = {}, {} {} {}{}", bound.name, shown_text(bound.value, shown),
                     bound.is_kept() ? "is" : "is not", words, shown_text(bound.bound, shown),
                     within > 0 ? fmt::format(" within {:g} %", 100 * within) : "");
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                   \
  template std::string text(const BoundState&, const PolarGrid<dim>&); \
  template decltype(quantity_context<dim>) quantity_context<dim>;      \
  template decltype(in_load_cases<dim>) in_load_cases<dim>;            \
  template decltype(minimized_terms<dim>) minimized_terms<dim>;        \
  template decltype(bounded_functions<dim>) bounded_functions<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
