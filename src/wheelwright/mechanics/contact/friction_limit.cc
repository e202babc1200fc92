#include "wheelwright/mechanics/contact/friction_limit.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/mechanics/contact/contact_newton.h"
#include "wheelwright/mechanics/contact/contact_starts.h"

namespace wheelwright {
namespace {

/// The motion in which the loads push the rim along the ground: one by which the tread moves by 1 there.
struct Push {
  RimMotion motion;
  double force;  ///< that does work on it, at least 0
};

template <int dim>
double tread_radius(const ReducedContact<dim>& contact) {
  return norm<dim>(contact.points().front().position);
}

template <int dim>
Push push_along_ground(const ReducedContact<dim>& contact) {
  const RimControl& rim = contact.rim();
  const RimForce& preload = contact.preload_resultant();
  Push push{{}, 0};
  for (const FreeMotion& free : rim.free) {
    if (!is_along_ground(free)) continue;
    const double arm = free.direction.rotation != 0 ? tread_radius(contact) : 1;
    const double force = (free.force + work(preload, free.direction)) / arm;
    push.motion = combined(push.motion, force / arm, free.direction);
    push.force = std::hypot(push.force, force);
  }
  if (push.force > 0) push.motion = combined({}, 1 / push.force, push.motion);
  return push;
}

/// The unknowns without those of the motions along the ground.
template <int dim>
ContactUnknowns<dim> held(ContactUnknowns<dim> x, const RimControl& rim) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < rim.free.size(); ++k)
    if (!is_along_ground(rim.free[k])) kept.push_back(x.rim[k]);
  x.rim = std::move(kept);
  return x;
}

/// The resultant of a contact that slides everywhere.
struct Sliding {
  double against_push;  ///< the ground's force that does work on the motion of a push, with the other sign
  double normal_force;
};

template <int dim>
std::optional<Sliding> sliding_along(const ReducedContact<dim>& contact, const Vec<dim>& direction,
                                     const RimMotion& push, const ContactUnknowns<dim>& start,
                                     const Interrupt& interrupt) {
  const ReducedContact<dim> sliding = held_along_ground(contact.sliding_along(direction));
  const auto end = newton(sliding, touching(sliding, held(touching(contact, start), contact.rim())),
                          Cycling::change_fewer, interrupt);
  if (!end.converged) return {};
  Sliding result{0, 0};
  for (int i = 0; i < contact.n_points(); ++i) {
    const auto& point = contact.points()[i];
    const Vec<dim> traction = sliding.response(i, end.x.augmented[i]).traction;
    result.against_push -= point.weight * dot<dim>(traction, rim_displacement(point, push));
    result.normal_force -= point.weight * traction[0];
  }
  return result;
}

}  // namespace

bool is_along_ground(const FreeMotion& motion) {
  const RimMotion& d = motion.direction;
  return d.along_ground != 0 || d.rotation != 0 || d.along_axle != 0;
}

template <int dim>
double force_along_ground(const ReducedContact<dim>& contact) {
  return push_along_ground(contact).force;
}

template <int dim>
ReducedContact<dim> held_along_ground(const ReducedContact<dim>& contact) {
  RimControl rim = contact.rim();
  std::erase_if(rim.free, is_along_ground);
  return contact.under(rim);
}

template <int dim>
std::optional<FrictionLimit> friction_limit(const ReducedContact<dim>& contact,
                                            const ContactUnknowns<dim>& start, const Interrupt& interrupt) {
  const Push push = push_along_ground(contact);
  if (push.force == 0) return {};
  // The ground pushes against the motion of the lowest point of the tread.
  Vec<dim> lowest{};
  lowest[0] = tread_radius(contact);
  Vec<dim> against = displacement<dim>(push.motion, lowest);
  against[0] = 0;
  const double length = norm<dim>(against);
  for (double& component : against) component /= -length;
  Vec<dim> along = against;
  for (double& component : along) component = -component;
  const auto pushed = sliding_along<dim>(contact, against, push.motion, start, interrupt);
  const auto pulled = sliding_along<dim>(contact, along, push.motion, start, interrupt);
  if (!pushed || !pulled) return {};
  // Half way between the two the pressure is left, whose moment turns the rim.
  const double of_pressure = 0.5 * (pushed->against_push + pulled->against_push);
  return FrictionLimit{.needed = std::abs(push.force - of_pressure),
                       .available = 0.5 * (pushed->against_push - pulled->against_push),
                       .normal_force = 0.5 * (pushed->normal_force + pulled->normal_force)};
}

template <int dim>
FrictionLimit smooth_limit(const ReducedContact<dim>& contact, const ContactState<dim>& smooth) {
  double normal_force = 0;
  for (int i = 0; i < contact.n_points(); ++i)
    normal_force -= contact.points()[i].weight * smooth.traction[i][0];
  return {.needed = force_along_ground(contact),
          .available = contact.friction() * normal_force,
          .normal_force = normal_force};
}

template decltype(force_along_ground<2>) force_along_ground<2>;
template decltype(smooth_limit<2>) smooth_limit<2>;
template decltype(smooth_limit<3>) smooth_limit<3>;
template decltype(held_along_ground<2>) held_along_ground<2>;
template decltype(friction_limit<2>) friction_limit<2>;
template decltype(force_along_ground<3>) force_along_ground<3>;
template decltype(held_along_ground<3>) held_along_ground<3>;
template decltype(friction_limit<3>) friction_limit<3>;

}  // namespace wheelwright
