#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/quantities/functionals/shape_function.h"

namespace wheelwright {

/// What the functionals of a case depend on.
template <int dim>
QuantityContext<dim> quantity_context(const Case& c, const StateSolver<dim>& solver);

/// Terms that depend on the load, repeated for every load case, times its weight. Unchanged if there is only
/// one load.
template <int dim>
WeightedSum<dim> in_load_cases(const Case& c, WeightedSum<dim> terms);

/// How a case aggregates what it minimizes instead of its weighted sum.
Over minimized_over(const Case& c);

/// The terms of what a case minimizes instead of its weighted sum. Fails like the operators of the solver.
template <int dim>
Expected<WeightedSum<dim>> minimized_terms(const Case& c, const StateSolver<dim>& solver);

/// The functions that a case bounds: one for each constraint and load case, or one per load position. Their
/// names consist of the quantity, the positions unless it is the mean, the load case unless it is the first,
/// and a number if needed to be unique. `initial`: determines whether the wheel is mirror-symmetric, so that
/// a position and its image share a bound. Fails as the operators of the solver do.
template <int dim>
Expected<std::vector<ShapeFunction<dim>>> bounded_functions(const Case& c, const StateSolver<dim>& solver,
                                                            const LevelSet<dim>& initial);

/// One line, in the units of tables: name, value, relation and limit, and the tolerance if it is needed.
template <int dim>
std::string text(const BoundState& bound, const PolarGrid<dim>& grid);

}  // namespace wheelwright
