#pragma once

#include <span>

#include "wheelwright/base/expected.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The contribution of a function's adjoint problem (79) to the contact of one load position.
template <int dim>
struct ContactAdjointLoads {
  Matrix observations;                   ///< of p without the contact part, in the zone
  RimForce rim = {};                     ///< the function's derivative with respect to the rim's motion
  std::vector<Vec<dim>> tractions = {};  ///< and to the ground's tractions at points(); empty: zero
};

/// The contact part of the adjoint problem (79) at one load position.
struct ContactAdjoint {
  Matrix loads;          ///< -S^T m on the zone's observations, m the multiplier
  RimMotion rim;         ///< of the adjoint
  double by_travel = 0;  ///< the function's derivative with respect to a prescribed motion towards the ground
};

/// The multipliers of several functions' adjoint problems (79): the transpose of Newton's last linear system,
/// factored once.
template <int dim>
Expected<std::vector<ContactAdjoint>> contact_multipliers(
    const ReducedContact<dim>& contact, const ContactState<dim>& state,
    std::span<const ContactAdjointLoads<dim>> functions);

}  // namespace wheelwright
