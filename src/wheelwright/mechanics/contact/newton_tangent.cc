#include "wheelwright/mechanics/contact/newton_tangent.h"

namespace wheelwright {

template <int dim>
std::optional<ContactUnknowns<dim>> NewtonTangent<dim>::step(const ContactUnknowns<dim>& x,
                                                             const ContactUnknowns<dim>& residual) {
  if (!factored_ || factored_->tangents() != contact_->tangents(x.augmented))
    factored_ = ContactTangent<dim>::at(*contact_, x);
  if (!factored_) return {};
  auto step = factored_->solve(residual);
  if (!contact_->keeps_rim_near(step)) return {};
  return step;
}

template class NewtonTangent<2>;
template class NewtonTangent<3>;

}  // namespace wheelwright
