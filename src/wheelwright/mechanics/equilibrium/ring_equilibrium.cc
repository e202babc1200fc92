#include "wheelwright/mechanics/equilibrium/ring_equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/equilibrium/softening.h"
#include "wheelwright/mechanics/rolling/rolled_contact.h"

namespace wheelwright {
namespace {

/// A part of the loads and of the prescribed motion.
RimControl part_of(RimControl rim, double part) {
  rim.prescribed = combined({}, part, rim.prescribed);
  for (FreeMotion& motion : rim.free) motion.force *= part;
  return rim;
}

/// The force that presses the wheel to the ground; 0 if its travel is prescribed.
double pressing_force(const RimControl& rim) {
  double force = 0;
  for (const FreeMotion& motion : rim.free) force += motion.direction.towards_ground * motion.force;
  return force;
}

std::vector<double> sum(std::vector<double> a, double factor, const std::vector<double>& b) {
  for (size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
  return a;
}

template <int dim>
bool touches_edge(const ContactState<dim>& state) {
  const auto per_column = static_cast<long>(state.traction.size()) / state.zone.n_columns;
  const auto touches = [](auto first, auto last) {
    return std::any_of(first, last, [](const Vec<dim>& t) { return t[0] < 0; });
  };
  return touches(state.traction.begin(), state.traction.begin() + per_column) ||
         touches(state.traction.end() - per_column, state.traction.end());
}

}  // namespace

/// The answer of a linearization to the forces at a displacement: the change that it wants, with the contact
/// at its end.
template <int dim>
struct EquilibriumSolver<dim>::Correction {
  std::vector<double> step;
  ReducedContact<dim> contact;
  ContactState<dim> state;

  double size() const { return largest_magnitude(step); }
};

template <int dim>
EquilibriumSolver<dim>::EquilibriumSolver(const RollingModel<dim>& model, const RingProblem<dim>& problem,
                                          const Tread<dim>& tread)
    : model_(model), problem_(problem), tread_(tread), law_(contact_law_of(model)) {}

template <int dim>
int EquilibriumSolver<dim>::half_zone(double travel) const {
  const double radius = model_.grid.outer_radius, column = radius * model_.grid.column_angle();
  double half_width = 0.75 * std::sqrt(2 * radius * std::max(travel, 0.0));
  if (!model_.travel)
    half_width = std::max(
        half_width, 2.4 * std::sqrt(model_.load * radius /
                                    (std::numbers::pi * model_.materials.at_tread().contact_modulus())));
  return std::min(static_cast<int>(std::ceil(half_width / column)) + 2, (model_.grid.ring_columns() - 1) / 2);
}

template <int dim>
Expected<std::shared_ptr<const RingLinearization<dim>>> EquilibriumSolver<dim>::linearize(
    const std::vector<double>& v, GroundPosition ground, int half) const {
  auto zone = contact_points(tread_, model_.grid, ground,
                             {ground.column - half, 2 * half + (ground.offset > 0)}, model_.ground);
  return RingLinearization<dim>::at(problem_, v, std::move(zone), law_->is_tangential() ? dim : 1,
                                    model_.contact.tau());
}

template <int dim>
auto EquilibriumSolver<dim>::correction(const RingLinearization<dim>& linearization,
                                        const typename RingForms<dim>::Forces& forces,
                                        const std::vector<double>& v, const RimControl& rim,
                                        const std::optional<ContactState<dim>>& known,
                                        const Interrupt& interrupt) const
    -> Expected<Correction, ContactFailure> {
  Matrix loads(1, static_cast<int>(v.size()));
  for (size_t i = 0; i < v.size(); ++i) loads.data()[i] = -forces.internal[i] - forces.ghost[i];
  loads = linearization.eliminated(loads);

  const ContactZone& zone = linearization.zone();
  Preload preload{};
  const Matrix change = linearization.observed(linearization.trailing_displacements(loads), 0);
  preload.observations = Matrix(change.rows(), model_.grid.ring_columns());
  for (int c = 0; c < zone.n_columns; ++c) {
    const int column = wrap(zone.first_column + c, model_.grid.ring_columns());
    const auto values = problem_.observer.values(v, column);
    for (int i = 0; i < change.rows(); ++i) preload.observations(i, column) = values[i] + change(i, c);
  }
  ReducedContact<dim> contact(linearization.contact_operator(), law_, rim, preload);
  std::vector<ContactUnknowns<dim>> starts;
  if (known) starts.push_back(start_from(contact, *known));
  const double force = pressing_force(rim);
  starts.push_back(force > 0 ? hertz_start(contact, force, model_.grid.outer_radius,
                                           model_.materials.at_tread().contact_modulus())
                             : undeformed_start(contact));
  auto state = solve_contact<dim>(contact, starts, interrupt);
  if (!state) return state.failure();
  linearization.add_contact_loads(contact_loads(contact, *state), 0, loads);
  const Matrix step = linearization.displacements(std::move(loads));
  return Correction{std::vector<double>(step.data(), step.data() + step.columns()), std::move(contact),
                    *std::move(state)};
}

template <int dim>
auto EquilibriumSolver<dim>::newton(const RimControl& rim, GroundPosition ground,
                                    const EquilibriumStart<dim>& start, int half,
                                    const Interrupt& interrupt) const -> Result {
  constexpr int max_tangents = 15;
  constexpr double smallest_part = 1.0 / 64, good_contraction = 0.1, tolerance = 1e-10;
  std::vector<double> v = start.v;
  std::optional<ContactState<dim>> known = start.contact;
  int n_corrections = 0;
  for (int n_tangents = start.linearization ? 0 : 1; n_tangents <= max_tangents; ++n_tangents) {
    if (interrupt.requested())
      return EquilibriumFailure{{FailureReason::interrupted, "while the wheel was deformed"}};
    auto linearization = n_tangents == 0 ? start.linearization : linearize(v, ground, half);
    if (!linearization) {
      EquilibriumFailure failure{linearization.failure()};
      if (failure.reason == FailureReason::not_positive_definite) failure.unstable = v;
      return failure;
    }
    auto wanted = correction(**linearization, (**linearization).forces(), v, rim, known,
                             interrupt.after_steps(n_tangents + n_corrections));
    if (!wanted) return EquilibriumFailure{wanted.failure()};
    const auto converged = [&](const Correction& last) {
      return last.size() <=
             tolerance * std::max(largest_magnitude(v), std::abs(last.state.rim.towards_ground));
    };
    const auto solved = [&](Correction last) {
      v = sum(std::move(v), 1, last.step);
      const double energy = problem_.forms.energy(v);
      return checked({ground, std::move(v), std::move(last.contact), std::move(last.state), energy,
                      n_tangents, n_corrections},
                     **linearization);
    };
    if (converged(*wanted)) return solved(*std::move(wanted));
    bool is_good = true;
    while (is_good) {
      double part = 1;
      for (;; part /= 2) {
        if (part < smallest_part)
          return EquilibriumFailure{
              {FailureReason::newton_stalled,
               fmt::format("Newton's method for the deformed wheel stalled after {} tangents", n_tangents)}};
        auto trial = sum(v, part, wanted->step);
        const auto forces = problem_.forms.forces(trial);
        if (!forces.admissible()) continue;
        auto next = correction(**linearization, forces, trial, rim, wanted->state,
                               interrupt.after_steps(n_tangents + n_corrections));
        ++n_corrections;
        if (!next && next.failure().reason == FailureReason::interrupted)
          return EquilibriumFailure{next.failure()};
        if (!next) continue;
        const double contraction = next->size() / wanted->size();
        if (!(contraction <= 1 - part / 4)) continue;
        v = std::move(trial);
        known = next->state;
        is_good = part == 1 && contraction <= good_contraction;
        wanted = std::move(next);
        break;
      }
      if (converged(*wanted)) return solved(*std::move(wanted));
    }
  }
  return EquilibriumFailure{
      {FailureReason::newton_stalled,
       fmt::format("Newton's method for the deformed wheel did not converge with {} tangents",
                   max_tangents)}};
}

template <int dim>
auto EquilibriumSolver<dim>::solve_under(const RimControl& rim, GroundPosition ground,
                                         const EquilibriumStart<dim>& start, const Interrupt& interrupt) const
    -> Result {
  double travel = rim.prescribed.towards_ground;
  int half = half_zone(travel);
  if (start.contact) half = std::max(half, start.contact->zone.n_columns / 2);
  const int widest = (model_.grid.ring_columns() - 1) / 2;
  for (EquilibriumStart<dim> from = start;;) {
    if (from.linearization && from.linearization->zone().n_columns < 2 * half) from.linearization.reset();
    auto solved = newton(rim, ground, from, half, interrupt);
    if (!solved || !touches_edge(solved->state) || half == widest) return solved;
    half = std::min(widest, std::max(half + 2, half_zone(solved->state.rim.towards_ground)));
    from = {solved->v, solved->state};
  }
}

template <int dim>
auto EquilibriumSolver<dim>::solve(GroundPosition ground, const std::optional<EquilibriumStart<dim>>& start,
                                   const Interrupt& interrupt) const -> Result {
  const RimControl rim = rim_control(model_);
  std::optional<EquilibriumFailure> failure;
  if (start) {
    auto solved = solve_under(rim, ground, *start, interrupt);
    if (solved || solved.failure().reason == FailureReason::interrupted) return solved;
  }
  constexpr double largest_step = 0.025, smallest_step = 1.0 / 64;  // of the thickness; of the first step
  const double thickness = model_.grid.outer_radius - model_.grid.inner_radius;
  EquilibriumStart<dim> from{std::vector<double>(problem_.forms.space().n_dofs(), 0.0)};
  double travel = rim.prescribed.towards_ground;
  if (!model_.travel) {
    const auto undeformed = linearize(from.v, ground, half_zone(0));
    if (!undeformed) return EquilibriumFailure{undeformed.failure()};
    const auto linear = correction(**undeformed, (**undeformed).forces(), from.v, rim, {}, interrupt);
    if (!linear) return EquilibriumFailure{linear.failure()};
    travel = linear->state.rim.towards_ground;
  }
  const double first = std::min(1.0, largest_step * thickness / std::max(travel, 1e-300));
  double reached = 0, length = first;
  std::optional<RingEquilibrium<dim>> last;
  std::vector<double> slope;  // dv by part
  int n_tangents = 0, n_corrections = 0;
  while (reached < 1) {
    const double next = std::min(1.0, reached + length);
    EquilibriumStart<dim> guess = from;
    if (!slope.empty()) {
      guess.v = sum(from.v, next - reached, slope);
      if (!std::isfinite(problem_.forms.energy(guess.v))) guess.v = from.v;
    }
    auto solved = solve_under(part_of(rim, next), ground, guess, interrupt);
    if (!solved) {
      if (solved.failure().reason == FailureReason::interrupted) return solved;
      length /= 2;
      if (length >= smallest_step * first && !(solved.failure().instability && length < first / 4)) continue;
      if (!model_.travel && last) return beyond(rim, *last, solved.failure(), interrupt);
      return explained(solved.failure(), ground, last ? &*last : nullptr);
    }
    n_tangents += solved->n_tangents;
    n_corrections += solved->n_corrections;
    if (reached > 0) {
      slope = sum(solved->v, -1, from.v);
      for (double& x : slope) x /= next - reached;
    }
    if (solved->n_tangents <= 3) length *= 2;
    from = {solved->v, solved->state};
    last = *std::move(solved);
    reached = next;
  }
  last->n_tangents = n_tangents;
  last->n_corrections = n_corrections;
  return *std::move(last);
}

template <int dim>
auto EquilibriumSolver<dim>::solve_from(const RingEquilibrium<dim>& solution,
                                        std::shared_ptr<const RingLinearization<dim>> linearization,
                                        const Interrupt& interrupt) const -> Result {
  const RimControl rim = rim_control(model_);
  auto solved =
      solve_under(rim, solution.ground, {solution.v, solution.state, std::move(linearization)}, interrupt);
  if (solved || solved.failure().reason == FailureReason::interrupted) return solved;
  if (pressing_force(rim) > solution.state.rim_force.towards_ground) {
    auto by_travel = beyond(rim, solution, solved.failure(), interrupt);
    if (by_travel || by_travel.failure().reason == FailureReason::overload ||
        by_travel.failure().reason == FailureReason::interrupted)
      return by_travel;
  }
  return solve(solution.ground, {}, interrupt);
}

template <int dim>
auto EquilibriumSolver<dim>::checked(RingEquilibrium<dim> solution, const RingLinearization<dim>& near) const
    -> Result {
  if (is_stable(near, solution.contact, solution.state)) return solution;
  EquilibriumFailure failure{{FailureReason::not_positive_definite,
                              fmt::format("the deformed wheel is unstable at a travel of {:.4g} m",
                                          solution.state.rim.towards_ground)}};
  const std::vector<double> zero(solution.v.size(), 0.0);
  const auto undeformed = linearize(zero, solution.ground, solution.state.zone.n_columns / 2);
  if (undeformed)
    failure.instability = first_instability(near, **undeformed, solution.contact, solution.state);
  if (failure.instability)
    failure.detail += fmt::format(": the stiffness of its weakest mode is {:.3g} of the undeformed wheel's",
                                  failure.instability->eigenvalue);
  return failure;
}

template <int dim>
EquilibriumFailure EquilibriumSolver<dim>::explained(EquilibriumFailure failure, GroundPosition ground,
                                                     const RingEquilibrium<dim>* last) const {
  if (failure.instability) return failure;
  if (const auto stretch = last ? smallest_stretch_of_saint_venant(problem_.forms, last->v) : std::nullopt;
      stretch && *stretch < softening_stretch)
    return {
        {FailureReason::overload,
         fmt::format("at a travel of {:.4g} m material is compressed to {:.2g} of its length, but the stress "
                     "of Saint Venant and Kirchhoff's law falls below {:.2g}; neo_hookean stiffens",
                     last->state.rim.towards_ground, *stretch, softening_stretch)}};
  if (failure.unstable.empty()) return failure;
  const int half = half_zone(model_.travel.value_or(0));
  failure.instability =
      instability_off_the_ground(problem_, failure.unstable, {ground.column - half, 2 * half});
  if (failure.instability)
    failure.detail += fmt::format(": the stiffness of its weakest mode is {:.3g} of the undeformed wheel's",
                                  failure.instability->eigenvalue);
  return failure;
}

template <int dim>
auto EquilibriumSolver<dim>::beyond(const RimControl& rim, const RingEquilibrium<dim>& last,
                                    EquilibriumFailure failure, const Interrupt& interrupt) const -> Result {
  constexpr double step = 0.0125, shortest = step / 8, farthest = 0.5;  // of the thickness
  const double thickness = model_.grid.outer_radius - model_.grid.inner_radius, wanted = pressing_force(rim);
  double travel = last.state.rim.towards_ground, largest = last.state.rim_force.towards_ground,
         at_largest = travel;
  RingEquilibrium<dim> reached = last;
  for (double length = step; travel < farthest * thickness;) {
    RimControl held;
    held.prescribed.towards_ground = travel + length * thickness;
    for (const FreeMotion& motion : rim.free)
      if (motion.direction.towards_ground == 0) held.free.push_back(motion);
    auto solved = solve_under(held, last.ground, {reached.v, reached.state}, interrupt);
    if (!solved) {
      if (solved.failure().reason == FailureReason::interrupted) return solved;
      length /= 2;
      if (length >= shortest) continue;
      return explained(solved.failure().instability ? solved.failure() : std::move(failure), last.ground,
                       &reached);
    }
    reached = *std::move(solved);
    travel = reached.state.rim.towards_ground;
    const double force = reached.state.rim_force.towards_ground;
    if (force >= wanted) return solve_under(rim, last.ground, {reached.v, reached.state}, interrupt);
    if (force < largest)
      return EquilibriumFailure{
          {FailureReason::overload,
           fmt::format("the wheel carries at most about {:.4g} N{} at this position, at a travel of {:.4g} m",
                       largest, dim == 2 ? "/m" : "", at_largest),
           largest}};
    largest = force;
    at_largest = travel;
  }
  return explained(std::move(failure), last.ground, &reached);
}

template <int dim>
auto EquilibriumSolver<dim>::linearized(const RingEquilibrium<dim>& solution, const Interrupt& interrupt,
                                        int half_zone) const
    -> Expected<LinearizedEquilibrium<dim>, EquilibriumFailure> {
  auto linearization =
      linearize(solution.v, solution.ground, std::max(half_zone, solution.state.zone.n_columns / 2));
  if (!linearization) return EquilibriumFailure{linearization.failure()};
  auto last = correction(**linearization, (**linearization).forces(), solution.v, rim_control(model_),
                         solution.state, interrupt);
  if (!last) return EquilibriumFailure{last.failure()};
  RingEquilibrium<dim> result = solution;
  result.v = sum(std::move(result.v), 1, last->step);
  result.contact = std::move(last->contact);
  result.state = std::move(last->state);
  auto stable = checked(std::move(result), **linearization);
  if (!stable) return stable.failure();
  return LinearizedEquilibrium<dim>{*std::move(stable), *std::move(linearization)};
}

template class EquilibriumSolver<2>;

}  // namespace wheelwright
