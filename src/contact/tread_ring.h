#pragma once

#include "contact/tread.h"

namespace wheelwright {

/// Fields of the whole tread for several right-hand sides: one column for every (right-hand side, ring
/// column), column = rhs * n_columns + ring column. Observations have Tread::n_observations() rows; the outer
/// line of the core has `per_column` rows: its unknowns of one angular cell.

/// Loads on the core's outer line (per_column rows) that observation loads send through the tread.
template <int dim>
Matrix base_loads(const Tread<dim>& tread, const Matrix& observation_loads);

/// Observations for displacements of the outer line and observation loads.
template <int dim>
Matrix observe(const Tread<dim>& tread, const Matrix& outer_line, const Matrix& observation_loads);

/// Displacements of the tread's nodes above the base, rows as in Tread::nodal_transfer, one column a ring
/// column.
template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const Matrix& outer_line,
                           const Matrix& observation_loads);

}  // namespace wheelwright
