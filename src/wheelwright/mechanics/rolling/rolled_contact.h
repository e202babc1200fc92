#pragma once

#include <optional>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"
#include "wheelwright/mechanics/state/rolling_model.h"

namespace wheelwright {

/// The contact law of a model: its own, or that of its contact form.
template <int dim>
std::shared_ptr<const ContactLaw<dim>> contact_law_of(const RollingModel<dim>& model) {
  return model.contact_law ? model.contact_law : law_of<dim>(model.contact);
}

/// Whether the whole tread is in contact, in one linear problem, as that of a tread bonded to a ring.
template <int dim>
bool has_linear_contact(const RollingModel<dim>& model) {
  return contact_law_of(model)->is_linear();
}

/// One load position's contact problem and its solution.
template <int dim>
struct RolledContact {
  ReducedContact<dim> contact;
  ContactState<dim> state;
};

/// The contact of a single load position, on a ring factored by solve(). The zone is widened until it
/// contains the contact; for a bonded tread it is the whole tread. `neighbour`: a solution to start from;
/// `preload`: the effect of all loads but the ground's.
template <int dim>
Expected<RolledContact<dim>> roll_to(const RollingModel<dim>& model, const Tread<dim>& tread,
                                     const CyclicStiffness<dim>& ring, const SurfaceCompliance<dim>& surface,
                                     GroundPosition ground, const Preload& preload,
                                     const std::optional<ContactState<dim>>& neighbour,
                                     const Interrupt& interrupt = {});

/// The same position under the loads or the travel of `model`, which differs in nothing else. It costs
/// little as long as the contact stays in the zone of `before`, on the same ground.
template <int dim>
Expected<RolledContact<dim>> reload(const RollingModel<dim>& model, const Tread<dim>& tread,
                                    const CyclicStiffness<dim>& ring, const SurfaceCompliance<dim>& surface,
                                    GroundPosition ground, const Preload& preload,
                                    const RolledContact<dim>& before);

/// The contacts of some load positions.
template <int dim>
struct RolledContacts {
  /// Of the ring; as wide as the widest contact zone.
  std::shared_ptr<const SurfaceCompliance<dim>> surface;
  std::vector<ReducedContact<dim>> contacts;
  std::vector<ContactState<dim>> states;
};

/// The contacts of all positions (position_tree.h). `known`: a surface for these positions, or null;
/// `preloads`: of every position.
template <int dim>
Expected<RolledContacts<dim>> roll_to_all(const RollingModel<dim>& model, const Tread<dim>& tread,
                                          const CyclicStiffness<dim>& ring,
                                          std::shared_ptr<const SurfaceCompliance<dim>> known,
                                          const LoadPositions& positions, std::span<const Preload> preloads,
                                          const Interrupt& interrupt);

}  // namespace wheelwright
