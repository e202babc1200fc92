#pragma once

#include <optional>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The force that friction must resist in the rim's free motions along the ground, and its limit, when all
/// contact points slide. A torque counts as the force at the tread that has its moment about the axle; the
/// moment of the pressure, whose centre need not lie below the axle, adds to it.
struct FrictionLimit {
  double needed, available;  ///< [N/m when dim = 2, N when dim = 3]
  double normal_force;       ///< of the ground, while all slides [the same]

  bool is_exceeded() const { return needed >= available; }
};

/// Whether a motion of the rim is one that friction resists.
bool is_along_ground(const FreeMotion& motion);

/// The loads that push the rim along the ground, without the moment of the pressure; a torque counts as the
/// force at the tread that has its moment about the axle.
template <int dim>
double force_along_ground(const ReducedContact<dim>& contact);

/// The same contact with the rim held in all motions that friction resists.
template <int dim>
ReducedContact<dim> held_along_ground(const ReducedContact<dim>& contact);

/// Solves the contact that slides everywhere against the loads along the ground, and the one that slides the
/// other way. Empty if no free motion is along the ground, if nothing moves it, or if that contact has no
/// solution.
template <int dim>
std::optional<FrictionLimit> friction_limit(const ReducedContact<dim>& contact,
                                            const ContactUnknowns<dim>& start, const Interrupt& interrupt);

/// The same by the contact without friction, the rim held along the ground: its normal force bears the
/// friction. An estimate, without the moment of the pressure.
template <int dim>
FrictionLimit smooth_limit(const ReducedContact<dim>& contact, const ContactState<dim>& smooth);

}  // namespace wheelwright
