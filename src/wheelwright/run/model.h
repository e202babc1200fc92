#pragma once

#include "wheelwright/case/case.h"
#include "wheelwright/geometry/level_set.h"
#include "wheelwright/optimize/optimizer.h"
#include "wheelwright/sensitivity/evaluate.h"

namespace wheelwright {

/// The solver's view of a case: what every command that computes builds from it.
PolarGrid<2> polar_grid(const Case& c);
RollingModel<2> rolling_model(const Case& c);
/// The terms of the objective with weights > 0: the list of all criteria. Solves the initial shape when (83)
/// is to choose a weight. Fails as RollingProblem does.
Expected<Criteria<2>> criteria(const Case& c, const RollingProblem<2>& problem);

LevelSet<2> initial_shape(const Case& c);

/// What the nodes of the initial shape cannot hold of the case's holes: those that vanish between nodes, and
/// those that merge for the material between them is thinner than the nodes' distance.
std::vector<ShapeEvent<2>> lost_on_the_grid(const Case& c);

EvolutionOptions evolution_options(const Case& c);
OptimizerOptions optimizer_options(const Case& c);

/// Material area over the area of the ring, from the measure of one sector.
double volume_fraction(const PolarGrid<2>& grid, double measure);

}  // namespace wheelwright
