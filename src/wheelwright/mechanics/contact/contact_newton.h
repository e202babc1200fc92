#pragma once

#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The last iterate of Newton's method.
template <int dim>
struct NewtonEnd {
  ContactUnknowns<dim> x;
  int iterations = 0;
  double residual = 0;  ///< [Pa]
  bool converged = false;
};

/// What Newton's method does if full steps no longer reduce the number of changing points.
enum class Cycling { give_up, change_fewer };

template <int dim>
bool touches(const ContactUnknowns<dim>& x);

/// x, but where friction must hold the rim and all that touches slides along the same line, so that nothing
/// resists a motion along it and the tangent is singular: then the point that lacks least to stick sticks.
template <int dim>
ContactUnknowns<dim> sticking_somewhere(const ReducedContact<dim>& contact, ContactUnknowns<dim> x);

/// A semi-smooth Newton method. Its start touches the ground, or the rim is held. `interrupt` is polled
/// before every step and receives the progress, including `steps_before` earlier steps.
template <int dim>
NewtonEnd<dim> newton(const ReducedContact<dim>& contact, ContactUnknowns<dim> start, Cycling when_cycling,
                      const Interrupt& interrupt, int steps_before = 0);

/// The solution next to x, which solves the contact problem but for rounding errors: no point changes its
/// status on purpose, even if all of them slide.
template <int dim>
NewtonEnd<dim> without_rounding_errors(const ReducedContact<dim>& contact, ContactUnknowns<dim> x);

/// A linear law, as that of a bonded tread: one linear solve, and another one that lowers its rounding
/// errors.
template <int dim>
Expected<ContactState<dim>> solve_linear(const ReducedContact<dim>& contact);

}  // namespace wheelwright
