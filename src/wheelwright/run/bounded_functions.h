#pragma once

#include "wheelwright/base/quantity.h"
#include "wheelwright/case/case.h"
#include "wheelwright/functionals/shape_function.h"
#include "wheelwright/optimize/constraints.h"

namespace wheelwright {

/// Terms that depend on the load, under every load case of a case, times its weight. Unchanged if it has one
/// load alone.
template <int dim>
WeightedSum<dim> in_load_cases(const Case& c, WeightedSum<dim> terms);

/// The terms of what a case minimizes in place of its weighted sum. Fails as the operators of the solver do.
template <int dim>
Expected<WeightedSum<dim>> minimized_terms(const Case& c, const StateSolver<dim>& solver);

/// The functions that a case bounds: one for each constraint and load case, or one per load position. Their
/// names are that of the quantity, then which positions they are about where that is not the mean, then the
/// load case if it is not the first, and a number where a name is there already. `initial`: tells whether the
/// wheel is its own mirror image, so that a position and its image share a bound. Fails as the operators of
/// the solver do.
template <int dim>
Expected<std::vector<ShapeFunction<dim>>> bounded_functions(const Case& c, const StateSolver<dim>& solver,
                                                            const LevelSet<dim>& initial);

/// The quantity that a function with such a name is about.
Quantity quantity_of(std::string_view function_name);

/// One line, in the units of tables: name, value, relation and limit.
template <int dim>
std::string text(const BoundState& bound, const PolarGrid<dim>& grid);

}  // namespace wheelwright
