#pragma once

#include "wheelwright/mechanics/ring/tread_ring.h"
#include "wheelwright/mechanics/rolling/preload.h"

namespace wheelwright {

/// The displacement of all positions, as in RollingSolution, and what follows from it.
template <int dim>
struct RecoveredFields {
  Matrix outer_line;
  PartialCholesky::Sweep sweep;
  SectorFields displacement;
  Matrix observations;
  Matrix ghost_loads;
};

/// The displacement under the loads on the tread. Fails if it is not finite or does not solve the equations
/// of a sector.
template <int dim>
Expected<RecoveredFields<dim>> recover(const FactoredShape<dim>& shape, const Tread<dim>& tread,
                                       const LoadPositions& positions, const Preloaded<dim>& preloaded,
                                       const TreadLoads& loads);

/// Displacements of equally many load cases per group, and the loads that they belong to.
struct SolvedFields {
  const SectorFields& displacement;
  const Matrix& observations;  ///< of the tread, group by group
  const Matrix& ghost_loads;   ///< ghost penalty applied to the modes
  const SectorFields& core_loads;
  const Matrix& tread_loads;               ///< on the observations
  const std::vector<int>& loaded_columns;  ///< of tread_loads
};

/// The strain energy of every group: half the work of all loads, less the ghost penalty's and Nitsche's share
/// of it. `nitsche_factors` as in RollingProblem.
std::vector<double> strain_energies(const SolvedFields& fields, int n_groups,
                                    const std::vector<double>& nitsche_factors);

/// J_e (3) of every position. `nitsche_factors` as in RollingProblem. Fails if one of them is not positive.
template <int dim>
Expected<std::vector<double>> strain_energies(const RecoveredFields<dim>& fields,
                                              const LoadPositions& positions, const SectorFields& core_loads,
                                              const Matrix& tread_loads,
                                              const std::vector<int>& loaded_columns,
                                              const std::vector<double>& nitsche_factors);

/// How many of a sector's positions each load case represents.
std::vector<double> case_multiplicities(const LoadPositions& positions, int n_sectors);

}  // namespace wheelwright
