#pragma once

#include <span>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/contact/reduced_contact.h"

namespace wheelwright {

/// Solves the contact problem of one load position by a semi-smooth Newton method, from each of the starts
/// until one leads to a solution. A step changes the contact status of all points that ask for it, as long as
/// their number falls; then of the last one alone, which ends cycles (block principal pivoting: Judice and
/// Pires, Computers & Operations Research 21, 1994). With friction even that may cycle: then it follows a
/// path (contact_path.h) in the plane, and in space solves a sequence of problems with given friction. A
/// wheel whose rim is held may stay off the ground. Fails with newton_stalled, with no_contact if other loads
/// lift the wheel, or with interrupted once `interrupt`, which is polled and told of before every step, asks
/// for it. A bonded tread is a linear problem, which needs no start.
template <int dim>
Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>& contact,
                                          std::span<const ContactUnknowns<dim>> starts,
                                          const Interrupt& interrupt = {});

}  // namespace wheelwright
