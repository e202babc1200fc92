#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/rolling/tread_cells.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The displacement of a solution in all unknowns of core and tread.
template <int dim>
class RingDisplacement : public Displacement<dim> {
 public:
  /// Both must outlive this.
  RingDisplacement(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution);

  RingField at_nodes(int position) const override;
  FactoredField strains(int cell, std::span<const Vec<dim>> points) const override;
  FactoredField strains_and_rotations(int cell, std::span<const Vec<dim>> points) const override;

 private:
  /// Displacements of a cell's dofs: one row per dof, one column per (position, sector).
  Matrix cell_displacements(int cell) const;
  Matrix core_values(int position) const;
  std::optional<Vec<dim>> at_node(const Matrix& core, int position, int sector,
                                  const std::array<int, dim>& node) const;

  const RollingProblem<dim>& problem_;
  const RollingSolution<dim>& solution_;
  Lattice<dim> lattice_;
  SectorFields core_;
  TreadCells<dim> tread_cells_;
  TreadField tread_;
  Matrix tread_nodes_;  ///< rows as TreadColumn::nodal
};

}  // namespace wheelwright
