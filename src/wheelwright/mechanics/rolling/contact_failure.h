#pragma once

#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/state/rolling_model.h"

namespace wheelwright {

/// The gamma_0 that theta = -1 and 0 need at most, and the one beyond which pressures may oscillate by a
/// third from point to point.
constexpr double enough_gamma_0 = 14, largest_smooth_gamma_0 = 300;

/// The failure of a load position's contact problem in terms of the case: which load cannot be carried and
/// why, with the keys that would help. If the contact gives no reason, checks whether without friction the
/// load deforms the wheel beyond linear elasticity.
template <int dim>
Failure contact_failure(const ContactFailure& failure, const RollingModel<dim>& model,
                        const ReducedContact<dim>& contact);

/// The rim would travel farther than the ring is thick: it would be below the ground.
template <int dim>
std::optional<Failure> rim_under_ground(const RollingModel<dim>& model, const RimMotion& rim);

/// A solution without contact: a prescribed travel may be too small to reach the ground, or to be detected by
/// the contact's quadrature points.
template <int dim>
std::optional<Failure> no_contact(const RollingModel<dim>& model, const ReducedContact<dim>& contact,
                                  const ContactState<dim>& state);

}  // namespace wheelwright
