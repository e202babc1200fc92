#pragma once

#include <optional>
#include <vector>

#include "wheelwright/mechanics/contact/contact_tangent.h"

namespace wheelwright {

/// Newton's steps of one contact problem. The tangent is refactored if the derivative of the contact law
/// changed at some point since the last step. (Updates by Woodbury's formula are faster, but their rounding
/// errors left contacts at a corner of the law unsolved.)
template <int dim>
class NewtonTangent {
 public:
  /// Refers to `contact`.
  explicit NewtonTangent(const ReducedContact<dim>& contact) : contact_(&contact) {}

  /// The step at x, to be subtracted. Empty if the tangent is singular or the rim would move farther than the
  /// tread's radius.
  std::optional<ContactUnknowns<dim>> step(const ContactUnknowns<dim>& x,
                                           const ContactUnknowns<dim>& residual);

 private:
  const ReducedContact<dim>* contact_;
  std::optional<ContactTangent<dim>> factored_;
};

}  // namespace wheelwright
