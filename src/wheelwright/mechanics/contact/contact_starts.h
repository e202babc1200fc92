#pragma once

#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

// Initial guesses for Newton's method.

/// The pressure of the Hertz contact of a solid disc, `centre` from below the axle along the ground.
template <int dim>
ContactUnknowns<dim> hertz_start(const ReducedContact<dim>& contact, double load, double radius,
                                 double reduced_modulus, double centre = 0);

/// The undeformed tread under the rim's prescribed motion.
template <int dim>
ContactUnknowns<dim> undeformed_start(const ReducedContact<dim>& contact);

/// Neither tractions nor motions.
template <int dim>
ContactUnknowns<dim> zero_start(const ReducedContact<dim>& contact);

/// The solution of another zone, where both zones are centred on their ground position.
template <int dim>
ContactUnknowns<dim> start_from(const ReducedContact<dim>& contact, const ContactState<dim>& other);

/// The guess itself if it touches the ground, or if the travel of the rim is prescribed; else the guess in
/// which the point nearest to the ground carries the load, so that every downward load reaches the ground.
template <int dim>
ContactUnknowns<dim> touching(const ReducedContact<dim>& contact, ContactUnknowns<dim> guess);

}  // namespace wheelwright
