#pragma once

#include <optional>

#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The derivative of the force that presses the wheel to the ground with respect to the rim's travel, while
/// the forces on the rim's other free motions stay as they are [Pa when dim = 2, N/m when dim = 3]. It is
/// that of the solved equations, at the flexibility of `contact`; at a load at which a contact point comes to
/// touch, that of the side on which `state` is. Nothing if the tangent with the travel held is singular.
template <int dim>
std::optional<double> tangent_stiffness(const ReducedContact<dim>& contact, const ContactState<dim>& state);

}  // namespace wheelwright
