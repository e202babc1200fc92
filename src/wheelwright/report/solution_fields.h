#pragma once

#include "wheelwright/rolling/rolling_problem.h"
#include "wheelwright/report/pressure_csv.h"
#include "wheelwright/report/ring_field.h"

namespace wheelwright {

/// u = v + the rim's motion of one load position at the nodes of the displacement's lattice, Cartesian, body
/// frame.
RingField displacement_field(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                             int position);

/// Component of a displacement towards the ground of one load position [m].
RingField vertical_field(const RingField& displacement, double ground_azimuth);

/// Von Mises stress [Pa] of a displacement, at the nodes: the mean over the cells with material around a
/// node.
RingField von_mises_field(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                          const RingField& displacement);

/// One value a node of a sector's level set lattice, as a field on the displacement's lattice, equal in all
/// sectors.
RingField repeated_field(const RollingProblem<2>& problem, const LevelSet<2>& sector_values);

/// The contact zones of all load positions.
std::vector<ContactPoint> contact_points(const RollingProblem<2>& problem,
                                         const RollingSolution<2>& solution);

}  // namespace wheelwright
