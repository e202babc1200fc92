#pragma once

#include <functional>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/contact/reduced_contact.h"

namespace wheelwright {

/// An initial guess for Newton's method that needs no other solution, under a fraction of the loads.
template <int dim>
using ColdStart = std::function<ContactUnknowns<dim>(double fraction)>;

/// Solves the contact problem of one load position by a semi-smooth Newton method with a line search on the
/// residual. It starts from the warm start if there is one, then from the cold start. If that fails, it
/// limits the change of the contact set per step, then applies the load in 2, 4 and 8 steps. Fails with
/// newton_stalled, which lists what was tried, with no_contact, which gives the smallest gap, or with
/// interrupted once `interrupt`, which is polled before every step, asks for it.
template <int dim>
Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>& contact,
                                          const ColdStart<dim>& cold_start,
                                          const std::optional<ContactUnknowns<dim>>& warm_start,
                                          const Interrupt& interrupt = {});

}  // namespace wheelwright
