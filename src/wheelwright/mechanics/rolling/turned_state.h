#pragma once

#include "wheelwright/mechanics/ring/cyclic_stiffness.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The shape of a wheel turned back by some columns, with its cells: what was in column `columns` is in
/// column 0 then, and another piece of the wheel is the sector.
template <int dim>
struct TurnedShape {
  LevelSet<dim> psi;
  CutDomain<dim> domain;
};
template <int dim>
TurnedShape<dim> turned_back(const LevelSet<dim>& psi, const CutDomain<dim>& domain, int columns);

/// The same of the ground.
template <int dim>
LoadPositions turned_back(LoadPositions positions, const PolarGrid<dim>& grid, int columns);

/// The columns at whose first azimuth a sector may be cut out of the ring: all of them, or those where a
/// mirror plane of the wheel is, if it has mirror planes at all. Turned back by such a column the wheel is
/// mirror-symmetric still.
template <int dim>
std::vector<int> possible_first_columns(const PolarGrid<dim>& grid, bool is_mirror_symmetric);

/// The one of these columns, of which the first is 0, where a sector shares the fewest nodes with its
/// neighbours, with those that ghost faces couple. 0 unless that saves a twentieth of them.
template <int dim>
int best_first_column(const CutDomain<dim>& domain, const ElementTable<dim>& table, int core_rows,
                      std::span<const int> columns);

/// The states of a shape, from those of the shape turned back. `domain`: cells of the shape.
template <int dim>
std::shared_ptr<const State<dim>> turned_state(std::shared_ptr<const State<dim>> turned,
                                               std::shared_ptr<const CutDomain<dim>> domain,
                                               LoadPositions positions, int columns,
                                               std::vector<PhaseTime> phases);

}  // namespace wheelwright
