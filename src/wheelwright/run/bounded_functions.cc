#include "wheelwright/run/bounded_functions.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/evolution/volume.h"
#include "wheelwright/functionals/material_volume.h"
#include "wheelwright/functionals/quantity_functional.h"
#include "wheelwright/functionals/uniformity_annulus.h"
#include "wheelwright/functionals/uniformity_dual.h"
#include "wheelwright/functionals/uniformity_l2.h"
#include "wheelwright/run/study.h"

namespace wheelwright {
namespace {

template <int dim>
using Pointer = std::shared_ptr<const Functional<dim>>;

/// The quantity as one term; the uniformities are those of the objective, summed over the positions.
template <int dim>
Expected<WeightedFunctional<dim>> term(const Case& c, const StateSolver<dim>& solver, Quantity quantity,
                                       Over over) {
  switch (quantity) {
    case Quantity::volume_fraction:
      return WeightedFunctional<dim>{1 / sector_measure<dim>(solver.model().grid),
                                     std::make_shared<MaterialVolume<dim>>()};
    case Quantity::uniformity_annulus:
      return WeightedFunctional<dim>{1, std::make_shared<UniformityAnnulus<dim>>(characteristic_length(c))};
    case Quantity::uniformity_l2:
      return WeightedFunctional<dim>{1, std::make_shared<UniformityL2<dim>>(characteristic_length(c))};
    case Quantity::uniformity_dual: {
      auto map = solver.neumann_to_dirichlet(c.objective.dual_norm);
      if (!map) return map.failure();
      return WeightedFunctional<dim>{1, std::make_shared<UniformityDual<dim>>(*std::move(map))};
    }
    default:
      return WeightedFunctional<dim>{
          1, quantity_functional<dim>(quantity, over, {.density = c.material.density.value_or(0)})};
  }
}

/// Whether the quantity has a separate value at every load position.
bool is_by_position(Quantity quantity) {
  switch (quantity) {
    case Quantity::strain_energy:
    case Quantity::mean_travel:
    case Quantity::travel:
    case Quantity::radial_force:
    case Quantity::stiffness:
    case Quantity::tangential_stiffness:
    case Quantity::torsional_stiffness:
    case Quantity::peak_pressure:
    case Quantity::peak_von_mises:
    case Quantity::peak_von_mises_inside:
      return true;
    default:
      return false;
  }
}

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

/// Whether a quantity depends on the load.
bool depends_on_the_load(Quantity quantity) {
  return quantity != Quantity::volume_fraction && quantity != Quantity::mass &&
         quantity != Quantity::perimeter;
}

Over positions_of(const Constraint& constraint) {
  if (!is_by_position(constraint.quantity) || constraint.over == OverPositions::mean) return Over::mean;
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
void add_bounded(const Constraint& constraint, const WeightedFunctional<dim>& term,
                 const std::string& in_case, const StateSolver<dim>& solver, bool are_images_alike,
                 std::vector<ShapeFunction<dim>>& functions) {
  const std::string quantity(name(constraint.quantity));
  const Over over = positions_of(constraint);
  const bool is_worst = over == Over::maximum || over == Over::minimum;
  const ShapeFunction<dim> function{.name = (is_worst ? quantity + " worst" : quantity) + in_case,
                                    .terms = {term},
                                    .bounds = bounds(constraint)};
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
WeightedSum<dim> in_load_cases(const Case& c, WeightedSum<dim> terms) {
  if (c.load.cases.empty()) return terms;
  WeightedSum<dim> result;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    for (const WeightedFunctional<dim>& term : terms)
      if (const double weight = c.load.cases[k].weight; weight > 0)
        result.push_back({weight * term.weight, term.functional, static_cast<int>(k)});
  return result;
}

template <int dim>
Expected<WeightedSum<dim>> minimized_terms(const Case& c, const StateSolver<dim>& solver) {
  const Over over = c.objective.over == OverPositions::worst ? Over::maximum : Over::mean;
  auto only = term(c, solver, c.objective.minimize, over);
  if (!only) return only.failure();
  WeightedSum<dim> terms{*std::move(only)};
  return depends_on_the_load(c.objective.minimize) ? in_load_cases(c, std::move(terms)) : std::move(terms);
}

template <int dim>
Expected<std::vector<ShapeFunction<dim>>> bounded_functions(const Case& c, const StateSolver<dim>& solver,
                                                            const LevelSet<dim>& initial) {
  const bool are_images_alike = distinct_positions(solver, load_cases<dim>(c), initial).stand_for_images();
  std::vector<ShapeFunction<dim>> functions;
  for (const Constraint& constraint : c.constraints) {
    auto only = term(c, solver, constraint.quantity, positions_of(constraint));
    if (!only) return only.failure();
    std::vector<int> cases{0};
    if (depends_on_the_load(constraint.quantity)) cases = load_cases_of(c, constraint);
    for (const int load_case : cases) {
      only->load_case = load_case;
      const std::string in_case = load_case > 0 ? " in " + c.load.cases[load_case].name : "";
      add_bounded(constraint, *only, in_case, solver, are_images_alike, functions);
    }
  }
  return functions;
}

Quantity quantity_of(std::string_view function_name) {
  const auto word = function_name.substr(0, function_name.find(' '));
  return static_cast<Quantity>(std::ranges::find(quantity_names, word) - quantity_names.begin());
}

template <int dim>
std::string text(const BoundState& bound, const PolarGrid<dim>& grid) {
  const char* words = bound.relation == '<' ? "at most" : bound.relation == '>' ? "at least" : "equal to";
  const ShownUnit shown = shown_unit(kind(quantity_of(bound.name)), dim, grid.width);
  return fmt::format("{} = {}, {} {} {}", bound.name, shown_text(bound.value, shown),
                     bound.is_kept() ? "is" : "is not", words, shown_text(bound.bound, shown));
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                         \
  template std::string text(const BoundState&, const PolarGrid<dim>&);                                       \
  template WeightedSum<dim> in_load_cases(const Case&, WeightedSum<dim>);                                    \
  template Expected<WeightedSum<dim>> minimized_terms(const Case&, const StateSolver<dim>&);                 \
  template Expected<std::vector<ShapeFunction<dim>>> bounded_functions(const Case&, const StateSolver<dim>&, \
                                                                       const LevelSet<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
