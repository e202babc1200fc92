#include "wheelwright/mechanics/contact/contact_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/mechanics/contact/contact_newton.h"
#include "wheelwright/mechanics/contact/contact_path.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/contact/friction_limit.h"

namespace wheelwright {
namespace {

/// The end of Newton's method from the last tried start, with the total number of steps, and the last
/// iterates of all failed attempts.
template <int dim>
struct NewtonAttempts {
  NewtonEnd<dim> end;
  std::vector<ContactUnknowns<dim>> last_iterates;
};

/// Newton's method from each start until one leads to a solution.
template <int dim>
NewtonAttempts<dim> newton_from_each(const ReducedContact<dim>& contact,
                                     std::span<const ContactUnknowns<dim>> starts, Cycling when_cycling,
                                     const Interrupt& interrupt) {
  NewtonAttempts<dim> attempts;
  int iterations = 0;
  for (const ContactUnknowns<dim>& start : starts) {
    if (attempts.end.converged || interrupt.requested()) break;
    attempts.end = newton(contact, touching(contact, start), when_cycling, interrupt, iterations);
    iterations += attempts.end.iterations;
    if (!attempts.end.converged) attempts.last_iterates.push_back(attempts.end.x);
  }
  attempts.end.iterations = iterations;
  return attempts;
}

/// The thresholds of Coulomb's law for the pressures of x.
template <int dim>
std::vector<double> thresholds(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  std::vector<double> result;
  for (const Vec<dim>& z : x.augmented) result.push_back(contact.friction() * negative_part(z[0]));
  return result;
}

/// Coulomb's friction as a sequence of problems with given friction: each takes its thresholds from the
/// pressures of the one before, until Newton's method for Coulomb's law itself converges from there.
template <int dim>
NewtonEnd<dim> newton_by_given_friction(const ReducedContact<dim>& contact, ContactUnknowns<dim> start,
                                        const Interrupt& interrupt) {
  constexpr int max_problems = 60;
  NewtonEnd<dim> end{std::move(start)};
  std::vector<double> given = thresholds(contact, end.x);
  for (int k = 0; k < max_problems && !end.converged && !interrupt.requested(); ++k) {
    auto solved =
        newton(contact.with_given_friction(given), end.x, Cycling::change_fewer, interrupt, end.iterations);
    solved.iterations += end.iterations;
    if (!solved.converged) return {std::move(solved.x), solved.iterations, solved.residual, false};
    given = thresholds(contact, solved.x);
    end = newton(contact, solved.x, Cycling::give_up, interrupt, solved.iterations);
    end.iterations += solved.iterations;
    if (!end.converged) end.x = std::move(solved.x);
  }
  return end;
}

/// Follows a path from x, then removes the rounding errors at its end. If these hide the solution, Newton's
/// method starts there.
NewtonEnd<2> newton_by_path(const ReducedContact<2>& contact, const ContactUnknowns<2>& x,
                            const Interrupt& interrupt, int steps_before) {
  const PathEnd<2> path = follow_path(contact, sticking_somewhere(contact, x), interrupt, steps_before);
  NewtonEnd<2> end;
  if (path.arrives) end = without_rounding_errors(contact, path.x);
  if (!end.converged) end = newton(contact, path.x, Cycling::give_up, interrupt, steps_before + path.turns);
  end.iterations += path.turns;
  return end;
}

/// The contact under a part of the change of load, from the loads of a first state to its own: `lack` is what
/// that state lacks of equilibrium under its own loads.
template <int dim>
ReducedContact<dim> under_part(const ReducedContact<dim>& contact, const std::vector<double>& lack,
                               double part) {
  RimControl rim = contact.rim();
  for (size_t k = 0; k < rim.free.size(); ++k) rim.free[k].force += (1 - part) * lack[k];
  return contact.under(rim);
}

/// Newton's method in steps of the loads along the ground, from a solution x of other such loads. A step that
/// fails is halved.
template <int dim>
NewtonEnd<dim> newton_by_load_steps(const ReducedContact<dim>& contact, ContactUnknowns<dim> x,
                                    const Interrupt& interrupt, int steps_before) {
  constexpr double largest = 0.25, smallest = 1e-3;
  const std::vector<double> lack = contact.residual(x).rim;
  double reached = 0, length = largest;
  NewtonEnd<dim> end;
  int iterations = 0;
  while (reached < 1 && length >= smallest && !interrupt.requested()) {
    const double part = std::min(1.0, reached + length);
    end = newton(under_part(contact, lack, part), x, Cycling::give_up, interrupt, steps_before + iterations);
    iterations += end.iterations;
    if (end.converged) {
      x = end.x;
      reached = part;
    }
    length = end.converged ? std::min(largest, 2 * length) : length / 2;
  }
  end.iterations = iterations;
  end.converged = reached == 1;
  return end;
}

/// The unknowns of the contact with the rim held along the ground, extended by zero motions along it.
template <int dim>
ContactUnknowns<dim> released(ContactUnknowns<dim> x, const RimControl& rim) {
  std::vector<double> all;
  for (auto held = x.rim.begin(); const FreeMotion& motion : rim.free)
    all.push_back(is_along_ground(motion) ? 0 : *held++);
  x.rim = std::move(all);
  return x;
}

NewtonEnd<2> led_from(const ReducedContact<2>& contact, const ContactUnknowns<2>& x,
                      const Interrupt& interrupt, int steps_before) {
  return newton_by_path(contact, x, interrupt, steps_before);
}

NewtonEnd<3> led_from(const ReducedContact<3>& contact, const ContactUnknowns<3>& x,
                      const Interrupt& interrupt, int steps_before) {
  return newton_by_load_steps(contact, x, interrupt, steps_before);
}

/// Paths from the last iterates of Newton's method, and from its starts.
NewtonEnd<2> where_newton_cycles(const ReducedContact<2>& contact, const NewtonAttempts<2>& newton,
                                 std::span<const ContactUnknowns<2>> starts, const Interrupt& interrupt) {
  std::vector<ContactUnknowns<2>> beginnings = newton.last_iterates;
  for (const ContactUnknowns<2>& start : starts) beginnings.push_back(touching(contact, start));
  NewtonEnd<2> end;
  int iterations = newton.end.iterations;
  for (const ContactUnknowns<2>& x : beginnings) {
    if (end.converged || interrupt.requested()) break;
    end = newton_by_path(contact, x, interrupt, iterations);
    iterations += end.iterations;
  }
  end.iterations = iterations;
  return end;
}

NewtonEnd<3> where_newton_cycles(const ReducedContact<3>& contact, const NewtonAttempts<3>& newton,
                                 std::span<const ContactUnknowns<3>> starts, const Interrupt& interrupt) {
  NewtonEnd<3> end = newton_by_given_friction(contact, touching(contact, starts.back()), interrupt);
  end.iterations += newton.end.iterations;
  return end;
}

/// Coulomb's friction where Newton's method fails. In the plane a path leads on from one of its last
/// iterates, or from one of the starts; in space, where the cone of friction is round, a sequence of problems
/// with given friction is solved. If that fails too, the rim is first held along the ground, and then loaded.
template <int dim>
NewtonEnd<dim> solve_with_friction(const ReducedContact<dim>& contact,
                                   std::span<const ContactUnknowns<dim>> starts,
                                   const NewtonAttempts<dim>& newton, const Interrupt& interrupt) {
  NewtonEnd<dim> end = where_newton_cycles(contact, newton, starts, interrupt);
  if (end.converged || interrupt.requested()) return end;
  const ReducedContact<dim> held = held_along_ground(contact);
  if (held.rim().free.size() == contact.rim().free.size()) return end;
  std::vector<ContactUnknowns<dim>> held_starts;
  for (ContactUnknowns<dim> x : starts) {
    x.rim.resize(held.rim().free.size());
    held_starts.push_back(std::move(x));
  }
  const auto attempts = newton_from_each<dim>(held, held_starts, Cycling::give_up, interrupt);
  const NewtonEnd<dim> standing =
      attempts.end.converged ? attempts.end : where_newton_cycles(held, attempts, held_starts, interrupt);
  const int before = end.iterations + standing.iterations;
  if (standing.converged) end = led_from(contact, released(standing.x, contact.rim()), interrupt, before);
  end.iterations = standing.converged ? before + end.iterations : before;
  return end;
}

/// The force that presses the wheel to the ground, if the rim is free to follow it.
template <int dim>
std::optional<double> pressing_force(const ReducedContact<dim>& contact) {
  for (const FreeMotion& motion : contact.rim().free)
    if (motion.direction.towards_ground != 0)
      return motion.force + work(contact.preload_resultant(), motion.direction);
  return {};
}

/// The limit of friction where the contact that slides everywhere has no solution: an estimate, if the loads
/// exceed it so far that searching for a state that holds would be in vain.
template <int dim>
std::optional<FrictionLimit> far_beyond_friction(const ReducedContact<dim>& contact,
                                                 const Interrupt& interrupt) {
  constexpr double far = 10;
  const auto smooth = solve_without_friction(contact, interrupt);
  if (!smooth) return {};
  const FrictionLimit limit = smooth_limit(contact, *smooth);
  return limit.needed > far * limit.available ? std::optional(limit) : std::nullopt;
}

/// The failure if no solution was found.
template <int dim>
ContactFailure failure_of(const ReducedContact<dim>& contact, const NewtonEnd<dim>& end,
                          const std::optional<FrictionLimit>& limit) {
  constexpr double at_the_limit = 0.99;
  if (!touches(end.x) || (limit && !(limit->normal_force > 0)))
    return {{FailureReason::no_contact, "the other loads lift the wheel off the ground"}, {}};
  if (limit && limit->needed >= at_the_limit * limit->available)
    return {
        {FailureReason::sliding,
         fmt::format("friction must resist {:.4g} but resists at most {:.4g} under a normal force of {:.4g}",
                     limit->needed, limit->available, limit->normal_force)},
        limit};
  return {{FailureReason::newton_stalled,
           fmt::format("the contact problem of {} points was not solved in {} Newton steps",
                       contact.n_points(), end.iterations)},
          limit};
}

}  // namespace

template <int dim>
Expected<ContactState<dim>, ContactFailure> solve_contact(const ReducedContact<dim>& contact,
                                                          std::span<const ContactUnknowns<dim>> starts,
                                                          const Interrupt& interrupt) {
  if (contact.law().is_linear()) {
    auto state = solve_linear(contact);
    if (!state) return ContactFailure{state.failure()};
    return *std::move(state);
  }
  if (const auto force = pressing_force(contact); force && !(*force > 0))
    return ContactFailure{{FailureReason::no_contact, "the other loads lift the wheel off the ground"}};
  const auto attempts = newton_from_each(
      contact, starts, contact.has_friction() ? Cycling::give_up : Cycling::change_fewer, interrupt);
  NewtonEnd<dim> end = attempts.end;
  std::optional<FrictionLimit> limit;
  if (!end.converged && contact.has_friction() && !interrupt.requested()) {
    limit = friction_limit(contact, starts.back(), interrupt);
    if (!limit) limit = far_beyond_friction(contact, interrupt);
    if (!limit || !limit->is_exceeded()) end = solve_with_friction<dim>(contact, starts, attempts, interrupt);
  }
  if (end.converged) return contact.state(end.x, end.iterations);
  if (interrupt.requested())
    return ContactFailure{{FailureReason::interrupted, "while the contact was solved"}};
  return failure_of(contact, end, limit);
}

template <int dim>
Expected<ContactState<dim>, ContactFailure> solve_without_friction(const ReducedContact<dim>& contact,
                                                                   const Interrupt& interrupt) {
  const ReducedContact<dim> smooth = held_along_ground(contact.sliding_along({}));
  const ContactUnknowns<dim> start = undeformed_start(smooth);
  return solve_contact<dim>(smooth, std::span(&start, 1), interrupt);
}

template decltype(solve_contact<2>) solve_contact<2>;
template decltype(solve_contact<3>) solve_contact<3>;
template decltype(solve_without_friction<2>) solve_without_friction<2>;
template decltype(solve_without_friction<3>) solve_without_friction<3>;

}  // namespace wheelwright
