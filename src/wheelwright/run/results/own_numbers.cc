#include "wheelwright/run/results/own_numbers.h"

#include <fmt/format.h>

#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/run/study/bounded_functions.h"

namespace wheelwright {
namespace {

template <int dim>
KnownNumber own_number(const Quantity& quantity, const Case& c, const StateSolver<dim>& solver,
                       const LevelSet<dim>& shape, const SolvedStates<dim>& states) {
  if (!states) return to_string(states.failure());
  const auto term = functional_of(quantity, quantity->usual, quantity_context(c, solver));
  if (!term) return to_string(term.failure());
  const Matrix mean =
      quantity->compares_with_mean ? mean_observations(solver.tread_surface(), **states) : Matrix();
  const FunctionalValue<dim> value = term->functional->evaluate(solver, shape, **states, mean);
  const bool is_of_whole = is_per_width(kind(quantity)) && kind(quantity) != UnitKind::energy;
  return term->weight * value.over_positions.value_or(value.of_shape) *
         (is_of_whole ? whole_width(dim, c.wheel.width) : 1);
}

}  // namespace

template <int dim>
OwnNumbers<dim> own_numbers(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& shape) {
  return [&](const SolvedStates<dim>& states) {
    std::vector<OwnNumber> numbers;
    for (const Quantity& quantity : c.vocabulary.quantities.own())
      numbers.push_back({quantity, own_number(quantity, c, solver, shape, states)});
    return numbers;
  };
}

template decltype(own_numbers<2>) own_numbers<2>;
template decltype(own_numbers<3>) own_numbers<3>;

}  // namespace wheelwright
