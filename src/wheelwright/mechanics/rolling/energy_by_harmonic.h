#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"

namespace wheelwright {

/// State::energy_by_harmonic(): the states are linear in their loads, so that the wave of a harmonic is the
/// state under the loads' wave, and its energy follows from their work.
template <int dim>
std::vector<double> energy_by_harmonic(const RollingProblem<dim>& problem,
                                       const RollingSolution<dim>& solution);

}  // namespace wheelwright
