#include "wheelwright/mechanics/contact/tangent_stiffness.h"

#include "wheelwright/mechanics/contact/contact_tangent.h"

namespace wheelwright {
namespace {

constexpr RimMotion travel{.towards_ground = 1};

/// Held at a travel; the other motions stay free.
RimControl with_travel_held(const RimControl& rim) {
  RimControl held{rim.prescribed, {}};
  for (const FreeMotion& motion : rim.free)
    if (motion.direction.towards_ground == 0) held.free.push_back(motion);
  return held;
}

}  // namespace

template <int dim>
std::optional<double> tangent_stiffness(const ReducedContact<dim>& contact, const ContactState<dim>& state) {
  const ReducedContact<dim> held = contact.under(with_travel_held(contact.rim()));
  ContactUnknowns<dim> x{state.augmented, std::vector<double>(held.n_free(), 0.0)}, by_travel = x;
  for (int i = 0; i < held.n_points(); ++i) {
    const Vec<dim> moved = rim_displacement(held.points()[i], travel);
    for (int d = 0; d < dim; ++d)
      by_travel.augmented[i][d] = d < held.components() ? held.points()[i].gamma * moved[d] : 0.0;
  }
  const auto tangent = ContactTangent<dim>::at(held, x);
  if (!tangent) return {};
  // The unknowns change by minus this.
  const ContactUnknowns<dim> reply = tangent->solve(by_travel);
  double stiffness = 0;
  for (int i = 0; i < held.n_points(); ++i) {
    const Vec<dim> moved = rim_displacement(held.points()[i], travel);
    for (int d = 0; d < held.components(); ++d)
      for (int k = 0; k < held.components(); ++k)
        stiffness +=
            held.points()[i].weight * moved[d] * tangent->tangents()[i][d][k] * reply.augmented[i][k];
  }
  return stiffness;
}

template decltype(tangent_stiffness<2>) tangent_stiffness<2>;
template decltype(tangent_stiffness<3>) tangent_stiffness<3>;

}  // namespace wheelwright
