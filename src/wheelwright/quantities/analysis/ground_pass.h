#pragma once

#include <span>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"

namespace wheelwright {

/// A wheel on its ground, which has moved along under it.
struct PassPlace {
  double shift;  ///< of the ground, towards larger azimuth [m]
  double rise;   ///< of the axle of the undeformed wheel that stands on it, above that on flat ground [m]
  Expected<std::vector<ContactSummary>> positions;  ///< of the state, in their order
};

/// The contact of all positions of a state while its ground passes below, slowly, under a rim that is held
/// along the ground unless a force moves it: under the state's load or, if its travel is prescribed, with the
/// axle at the height of shift 0. A place fails on its own, as the contact problem does.
template <int dim>
std::vector<PassPlace> ground_pass(const State<dim>& state, std::span<const double> shifts);

}  // namespace wheelwright
