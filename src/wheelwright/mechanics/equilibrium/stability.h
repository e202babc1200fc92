#pragma once

#include <optional>

#include "wheelwright/mechanics/equilibrium/ring_linearization.h"

namespace wheelwright {

/// A way in which a wheel leaves its equilibrium.
struct Instability {
  double eigenvalue;         ///< its stiffness by that of the undeformed wheel, held alike; not positive
  std::vector<double> mode;  ///< its displacement on the dofs of RingSpace, at most 1
};

/// Whether an equilibrium is stable with its contact held: the ground holds the points that touch along its
/// normal, and those that stick along itself too. `tangent`: at the equilibrium, whose nodes off the contact
/// zone are stable as it could be factored; `rim`: its free motions.
template <int dim>
bool is_stable(const RingLinearization<dim>& tangent, const ReducedContact<dim>& contact,
               const ContactState<dim>& state);

/// The mode in which an equilibrium that is_stable() denies leaves first. `undeformed`: in the same zone.
/// Empty if LAPACK fails.
template <int dim>
std::optional<Instability> first_instability(const RingLinearization<dim>& tangent,
                                             const RingLinearization<dim>& undeformed,
                                             const ReducedContact<dim>& contact,
                                             const ContactState<dim>& state);

/// The mode of a displacement v whose tangent cannot be factored, with all nodes of the tread in the zone
/// held: by inverse iteration with a shift. Empty if none is found.
template <int dim>
std::optional<Instability> instability_off_the_ground(const RingProblem<dim>& problem,
                                                      const std::vector<double>& v, const ContactZone& zone);

}  // namespace wheelwright
