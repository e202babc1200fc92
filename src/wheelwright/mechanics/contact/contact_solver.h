#pragma once

#include <span>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/friction_limit.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// Why a contact problem has no solution, or none was found.
struct ContactFailure : Failure {
  std::optional<FrictionLimit> limit = {};  ///< if friction must hold the rim and Newton's method failed
};

/// Solves the contact problem of one load position by a semi-smooth Newton method, from each of the starts
/// until one leads to a solution. A step changes the contact status of all points that require it, as long as
/// their number falls; then only that of the last one, which ends cycles (block principal pivoting: Judice
/// and Pires, Computers & Operations Research 21, 1994). With friction even that may cycle: then it follows a
/// path (contact_path.h) in the plane, and in space solves a sequence of problems with given friction; if
/// that fails too, it starts from the wheel whose rim is held along the ground. A wheel whose rim is held may
/// stay off the ground. Fails with sliding if friction cannot hold the rim, with no_contact if other loads
/// lift the wheel, with newton_stalled if none of these is the reason, or with interrupted once `interrupt`,
/// which is polled and told of before every step, asks for it. A bonded tread is a linear problem, which
/// needs no start.
template <int dim>
Expected<ContactState<dim>, ContactFailure> solve_contact(const ReducedContact<dim>& contact,
                                                          std::span<const ContactUnknowns<dim>> starts,
                                                          const Interrupt& interrupt = {});

/// The same contact without friction, the rim held along the ground, from the undeformed tread.
template <int dim>
Expected<ContactState<dim>, ContactFailure> solve_without_friction(const ReducedContact<dim>& contact,
                                                                   const Interrupt& interrupt = {});

}  // namespace wheelwright
