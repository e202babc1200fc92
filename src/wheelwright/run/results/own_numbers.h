#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/output/report/described_wheel.h"

namespace wheelwright {

/// The case's own quantities at a shape, aggregated as in histories. Refers to its arguments.
template <int dim>
OwnNumbers<dim> own_numbers(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& shape);

}  // namespace wheelwright
