#pragma once

#include "contact/tread.h"

namespace wheelwright {

/// Fields of the whole tread for several right-hand sides: one column for every (right-hand side, ring
/// column), column = rhs * n_columns + ring column. Observations have Tread::n_observations() rows; lines
/// (see Tread) have n_line() rows. Those of the core's outer line are as in CyclicStiffness: one column for
/// every (right-hand side, sector).

/// Loads on the core's outer line that observation loads send through the tread.
template <int dim>
Matrix base_loads(const Tread<dim>& tread, const Matrix& observation_loads);

/// What the tread does under displacements of the outer line and observation loads.
struct TreadField {
  Matrix base;          ///< displacements of every column's own base, n_base() rows
  Matrix lines;         ///< displacements of every column's first line
  Matrix observations;  ///< what is observed
};
template <int dim>
TreadField tread_field(const Tread<dim>& tread, const Matrix& outer, const Matrix& observation_loads);

/// Displacements of the grid's nodes above the base, rows as TreadColumn::nodal.
template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const TreadField& field, const Matrix& observation_loads);

}  // namespace wheelwright
