#pragma once

#include <optional>
#include <vector>

#include "wheelwright/contact/reduced_contact.h"

namespace wheelwright {

/// Newton's steps of one contact problem. From one iterate to the next the contact law changes its derivative
/// at a few points only: the tangent is factored once and corrected for these points (Woodbury's formula); it
/// is factored anew where they are many.
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
  std::optional<ContactUnknowns<dim>> corrected_step(const std::vector<Mat<dim>>& tangents,
                                                     const ContactUnknowns<dim>& residual) const;

  const ReducedContact<dim>* contact_;
  std::optional<ContactTangent<dim>> factored_;
};

}  // namespace wheelwright
