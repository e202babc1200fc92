#pragma once

#include "wheelwright/mechanics/ring/tread.h"

namespace wheelwright {

/// Fields of the whole tread for several right-hand sides: one column for every (right-hand side, ring
/// column), column = rhs * n_columns + ring column. Observations have Tread::n_observations() rows; lines
/// (see Tread) have n_line() rows. Those of the core's outer line are as in CyclicStiffness: one column for
/// every (right-hand side, sector).

/// Loads on the tread: on its observations, and on the nodes of the grid in it. One column per (right-hand
/// side, ring column); an empty matrix is zero.
struct TreadForces {
  Matrix on_observations;
  Matrix on_base;   ///< rows as the base of TreadColumn
  Matrix on_nodes;  ///< rows as TreadColumn::nodal
};

/// Loads on the tread, condensed onto what their columns keep (TreadColumn).
struct TreadLoads {
  int n_fields;              ///< columns of the whole tread, for all right-hand sides
  std::vector<int> columns;  ///< those with loads, ascending
  Matrix on_observations;    ///< the loads there; without columns if there are none
  Matrix on_nodes;           ///< the loads there; without columns if there are none
  Matrix on_retained;        ///< both of them and those on the base, on the retained unknowns
};
template <int dim>
TreadLoads tread_loads(const Tread<dim>& tread, const Matrix& observation_loads);
template <int dim>
TreadLoads tread_loads(const Tread<dim>& tread, const TreadForces& forces);

/// Loads on the core's outer line due to loads on the tread.
template <int dim>
Matrix base_loads(const Tread<dim>& tread, const TreadLoads& loads);

/// Displacements of the tread under displacements of the outer line and loads.
struct TreadField {
  Matrix base;   ///< displacements of every column's own base, n_base() rows
  Matrix lines;  ///< displacements of every column's first line
};
template <int dim>
TreadField tread_field(const Tread<dim>& tread, const Matrix& outer, const TreadLoads& loads);

/// Observations of a field, in all columns or in some of them.
template <int dim>
Matrix observations(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads);
template <int dim>
Matrix observations(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads,
                    std::span<const int> columns);

/// Displacements of the grid's nodes above the base, rows as TreadColumn::nodal. There must be no loads on
/// these nodes.
template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads);

}  // namespace wheelwright
