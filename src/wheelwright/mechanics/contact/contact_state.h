#pragma once

#include "wheelwright/linalg/dense.h"
#include "wheelwright/mechanics/state/rim.h"

namespace wheelwright {

/// Contact quadrature points near the ground position, in the order (column, point of the column).
struct ContactZone {
  int first_column;  ///< may be negative: columns are periodic
  int n_columns;
};

/// The contact-free response to distributed loads at one load position.
struct Preload {
  Matrix observations;  ///< of v on the tread, one column per ring column; empty: zero
  RimForce resultant;
  double growth = 0;       ///< of this position (ContactPatch) [m]
  double mean_growth = 0;  ///< of all positions [m]
};

/// The unknowns of one load position's contact problem; also used for their changes and the residual.
template <int dim>
struct ContactUnknowns {
  std::vector<Vec<dim>> augmented;  ///< z = tau sigma(u)n - gamma (u - g n_y), ground frame [Pa]
  std::vector<double> rim;          ///< coefficient of each free motion of the rim
};

/// The solution of one load position's contact problem, reduced to the zone.
template <int dim>
struct ContactState {
  ContactZone zone;
  std::vector<Vec<dim>> augmented;  ///< z
  std::vector<Vec<dim>> traction;   ///< Phi(z) on the body, ground frame: component 0 along n_y [Pa]
  RimMotion rim;
  RimForce rim_force;     ///< on the rim: its load, and the reaction in motions that are not free
  int newton_iterations;  ///< of all attempts
  double ground = 0;      ///< the ground position, in columns from the zone's first azimuth
};

}  // namespace wheelwright
