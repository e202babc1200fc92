#pragma once

#include "wheelwright/mechanics/ring/tread_ring.h"

namespace wheelwright {

/// The nodes of the level set grid's cells in the tread: where a cell's dofs stand among the tread's fields.
template <int dim>
class TreadCells {
 public:
  TreadCells(const Tread<dim>& tread, const PolarGrid<dim>& grid, int degree);

  /// Displacements of a cell (`radial` a row of the grid in the tread) in every (right-hand side, ring
  /// column): one row per dof of the cell. `nodal` is what nodal_displacements() gives.
  Matrix displacements(int radial, int axial, const TreadField& field, const Matrix& nodal) const;

  /// Adds loads on a cell's dofs, laid out in the same way.
  void add_loads(int radial, int axial, const Matrix& loads, TreadForces& forces) const;

  /// The row of a node above the base, at a position of the sector's lattice, in the nodal field of its ring
  /// column.
  int row_of_node(const std::array<int, dim>& node) const;

  /// Forces without any load, for so many (right-hand side, ring column).
  TreadForces no_forces(int n_fields) const;

 private:
  /// Where the first component of a node of a column's cell stands.
  struct Place {
    bool on_base;  ///< among the rows of the base, else among those of the nodes above it
    int row;
    bool in_next_column;  ///< in the field of the next ring column
  };
  Place place(int radial, int axial, int local_node) const;
  int field(const Place& place, int column) const;

  const Tread<dim>& tread_;
  int degree_, core_rows_, height_, axial_nodes_;
};

}  // namespace wheelwright
