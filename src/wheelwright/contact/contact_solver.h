#pragma once

#include <functional>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/contact/reduced_contact.h"

namespace wheelwright {

/// A start for Newton's method that knows no other solution, under a fraction of the loads.
template <int dim>
using ColdStart = std::function<ContactUnknowns<dim>(double fraction)>;

/// Solves one load position's contact problem by semi-smooth Newton with a line search on the residual: from
/// the warm start if there is one, then from the cold one; then with steps so short that the contact set
/// changes little; then with the load in 2, 4 and 8 steps. Fails with newton_stalled, saying what was tried,
/// or no_contact, saying the smallest gap, or interrupted once `interrupt`, polled before every step, asks.
template <int dim>
Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>& contact,
                                          const ColdStart<dim>& cold_start,
                                          const std::optional<ContactUnknowns<dim>>& warm_start,
                                          const Interrupt& interrupt = {});

}  // namespace wheelwright
