#pragma once

#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The derivative of a contact problem's residual, on the components of z on which tractions depend and the
/// rim's free motions. The columns of all other components are unit vectors.
template <int dim>
struct ActiveSystem {
  std::vector<Mat<dim>> tangents;  ///< of the contact law at every point
  std::vector<int> active;         ///< components of z, in the order (point, component)
  Matrix matrix;
};

template <int dim>
ActiveSystem<dim> active_system(const ReducedContact<dim>& contact, const std::vector<Vec<dim>>& z);

/// The derivative of the contact problem's residual at some unknowns, factored.
template <int dim>
class ContactTangent {
 public:
  /// Refers to `contact`. Empty if the derivative is singular.
  static std::optional<ContactTangent> at(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x);

  /// Returns the change of the unknowns that changes the residual by `residual`.
  ContactUnknowns<dim> solve(const ContactUnknowns<dim>& residual) const;

  /// The same for several residuals at once.
  std::vector<ContactUnknowns<dim>> solve(std::vector<ContactUnknowns<dim>> residuals) const;

  /// The derivative of the contact law at every point.
  const std::vector<Mat<dim>>& tangents() const { return tangents_; }

  /// The number of unknowns that were factored.
  int n_unknowns() const { return static_cast<int>(active_.size()) + contact_->n_free(); }

 private:
  ContactTangent(const ReducedContact<dim>& contact, ActiveSystem<dim> system, LuFactor factor)
      : contact_(&contact),
        tangents_(std::move(system.tangents)),
        active_(std::move(system.active)),
        factor_(std::move(factor)) {}

  const ReducedContact<dim>* contact_;
  std::vector<Mat<dim>> tangents_;  ///< of the contact law at every point
  std::vector<int> active_;
  LuFactor factor_;
};

}  // namespace wheelwright
