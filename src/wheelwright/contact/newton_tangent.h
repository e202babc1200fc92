#pragma once

#include <optional>
#include <vector>

#include "wheelwright/contact/reduced_contact.h"

namespace wheelwright {

/// Newton's steps of one contact problem. The tangent is factored anew where the derivative of the contact
/// law differs from that of the last step at some point. (Corrected for these points by Woodbury's formula it
/// is found sooner, but its rounding errors left contacts unsolved that come to a corner of the law.)
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
