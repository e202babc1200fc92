#pragma once

#include "wheelwright/mechanics/contact/reduced_contact.h"
#include "wheelwright/mechanics/state/contact_patch.h"

namespace wheelwright {

// What a solved contact problem is to the rest of the program.

/// Loads on the zone's observations (rows as in Tread, one column per zone column): -Te^T W Phi.
template <int dim>
Matrix contact_loads(const ReducedContact<dim>& contact, const ContactState<dim>& state);

/// Public view of a solution.
template <int dim>
ContactPatch<dim> contact_patch(const ReducedContact<dim>& contact, const ContactState<dim>& state);

/// The minimum distance to the ground, if no point touches [m].
template <int dim>
double smallest_gap(const ReducedContact<dim>& contact, const ContactState<dim>& state);

}  // namespace wheelwright
