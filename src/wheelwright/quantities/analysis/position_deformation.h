#pragma once

#include <vector>

#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/quantities/analysis/linear_theory_error.h"

namespace wheelwright {

/// How the material deforms at one load position. The root mean squares are those over the strain energy, a
/// mean in which each joule counts the same: they converge with finer grids, also where the strain at a
/// corner of the material has no bound and its largest value grows with every finer grid.
struct PositionDeformation {
  double largest_rotation;      ///< of the material against the rim, at the quadrature points [rad]
  double root_mean_strain;      ///< of the norm sqrt(eps:eps); when dim = 2, of the strains in the plane
  double root_mean_rotation;    ///< against the rim [rad]
  LinearTheoryError neglected;  ///< by linear theory; zero if large strains were computed
};

/// Of every position that was solved for.
template <int dim>
std::vector<PositionDeformation> position_deformations(const StateSolver<dim>& solver,
                                                       const State<dim>& state);

}  // namespace wheelwright
