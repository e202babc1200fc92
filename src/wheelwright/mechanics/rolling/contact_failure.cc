#include "wheelwright/mechanics/rolling/contact_failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "wheelwright/mechanics/contact/contact_results.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/contact/friction_limit.h"

namespace wheelwright {
namespace {

/// From the solver's forces to those of the whole wheel, as a case gives them.
template <int dim>
double whole_width(const RollingModel<dim>& model) {
  return dim == 2 ? model.grid.width : 1;
}

/// The keys of the loads along the ground.
template <int dim>
std::vector<std::string> keys_along_ground(const RollingModel<dim>& model) {
  std::vector<std::string> keys;
  if (model.horizontal_force != 0) keys.emplace_back("load.horizontal_force");
  if (model.lateral_force != 0) keys.emplace_back("load.lateral_force");
  if (model.torque != 0) keys.emplace_back("load.torque");
  if (tangential_norm<dim>(model.distributed.body_force) > 0) keys.emplace_back("load.body_force");
  return keys;
}

template <int dim>
Failure sliding(const FrictionLimit& limit, const RollingModel<dim>& model) {
  const bool is_torque = model.torque != 0 && model.lateral_force == 0;
  const double width = whole_width(model), scale = width * (is_torque ? model.grid.outer_radius : 1);
  const std::string unit = is_torque ? "N m" : "N";
  return {
      FailureReason::sliding,
      fmt::format("the wheel slides: friction must hold {:.4g} {} at this position and can hold {:.4g} {} "
                  "under the ground's normal force of {:.4g} N{}: use less {}, or more contact.friction or "
                  "{}",
                  scale * limit.needed, unit, scale * std::max(limit.available, 0.0), unit,
                  width * limit.normal_force,
                  model.travel ? fmt::format(" at the travel of {:.4g} m", *model.travel) : "",
                  fmt::join(keys_along_ground(model), ", "), model.travel ? "load.travel" : "load.force")};
}

template <int dim>
Failure lifted(const RollingModel<dim>& model) {
  if (model.travel)
    return {FailureReason::no_contact,
            fmt::format("the wheel does not touch the ground at the travel of {:.4g} m: increase load.travel",
                        *model.travel)};
  return {
      FailureReason::no_contact,
      fmt::format("the loads on the structure itself lift the wheel off the ground, on which load.force = "
                  "{:.4g} N presses it: increase load.force, or reduce load.body_force",
                  whole_width(model) * model.load)};
}

template <int dim>
Failure overload(const RollingModel<dim>& model, const std::string& what) {
  std::vector<std::string> keys = keys_along_ground(model);
  keys.insert(keys.begin(), model.travel ? "load.travel" : "load.force");
  if (norm<dim>(model.distributed.body_force) > 0 && keys.back() != "load.body_force")
    keys.emplace_back("load.body_force");
  if (model.distributed.angular_speed != 0) keys.emplace_back("load.speed");
  if (model.distributed.hole_pressure != 0) keys.emplace_back("load.hole_pressure");
  return {FailureReason::overload,
          fmt::format("{}, far beyond linear elasticity: use less {}, or a larger material.youngs_modulus",
                      what, fmt::join(keys, ", "))};
}

/// Whether gamma is so large that, with several points per cell, the contact is numerically overdetermined.
template <int dim>
std::optional<Failure> overdetermined(const RollingModel<dim>& model) {
  const ContactForm& form = model.contact;
  if (form.method != ContactMethod::nitsche || form.gamma_0 <= largest_smooth_gamma_0) return {};
  return Failure{
      FailureReason::inaccurate_solution,
      fmt::format("contact.gamma_0 = {:.4g} forbids even the gaps between the points of a cell, and leaves "
                  "their pressures undetermined: use contact.theta = -1 with contact.gamma_0 = {:g}",
                  form.gamma_0, enough_gamma_0)};
}

/// The reason for the missing solution that follows from `smooth`, the contact without friction.
template <int dim>
std::optional<Failure> reason_in(const ContactState<dim>& smooth, const RollingModel<dim>& model,
                                 const ReducedContact<dim>& contact) {
  constexpr double largest_strain = 0.25;
  if (auto under = rim_under_ground(model, smooth.rim)) return under;
  const FrictionLimit limit = smooth_limit(contact, smooth);
  if (contact.law().coulomb_friction() && limit.is_exceeded() && limit.needed > 0)
    return sliding(limit, model);
  double peak = 0;
  for (const Vec<dim>& traction : smooth.traction) peak = std::max(peak, -traction[0]);
  const double strain = peak / model.materials.at_tread().contact_modulus();
  if (strain > largest_strain)
    return overload(model, fmt::format("even without friction the pressure on the ground is {:.0f} % of the "
                                       "material's modulus",
                                       100 * strain));
  // Minimum ratio of friction to pressure.
  if (const double ratio = limit.needed / limit.normal_force; ratio * strain > largest_strain)
    return overload(model, fmt::format("the loads along the ground need friction of {:.0f} % of the "
                                       "material's modulus",
                                       100 * ratio * strain));
  return {};
}

/// Whether so few columns of cells touch the ground that friction cannot balance the loads among their
/// points.
template <int dim>
std::optional<Failure> too_few_columns(const ReducedContact<dim>& contact, const ContactState<dim>& smooth) {
  constexpr std::size_t enough = 3;
  const int per_column = contact.n_points() / contact.zone().n_columns;
  std::set<int> columns;
  for (int i = 0; i < contact.n_points(); ++i)
    if (smooth.traction[i][0] < 0) columns.insert(i / per_column);
  if (columns.size() >= enough) return {};
  return Failure{
      FailureReason::inaccurate_solution,
      fmt::format("the ground touches {} column{} of cells, where friction cannot balance the loads: "
                  "use more grid.angular_cells or grid.tread_levels",
                  columns.size(), columns.size() == 1 ? "" : "s")};
}

/// Why there is no solution, as far as known.
template <int dim>
Failure unexplained(const ContactFailure& failure, const RollingModel<dim>& model,
                    const ReducedContact<dim>& contact) {
  const auto smooth = solve_without_friction(contact);
  if (smooth)
    if (const auto reason = reason_in(*smooth, model, contact)) return *reason;
  if (const auto reason = overdetermined(model)) return *reason;
  if (!smooth) return overload(model, "even without friction the contact has no state of equilibrium");
  if (auto reason = too_few_columns(contact, *smooth)) return *std::move(reason);
  return {failure.reason,
          failure.detail + ": try another contact.gamma_0, less contact.friction, or another grid"};
}

}  // namespace

template <int dim>
std::optional<Failure> rim_under_ground(const RollingModel<dim>& model, const RimMotion& rim) {
  const double thickness = model.grid.outer_radius - model.grid.inner_radius;
  if (rim.towards_ground < thickness) return {};
  return Failure{FailureReason::rim_under_ground,
                 fmt::format("the rim would travel {:.4g} m, but the ring is {:.4g} m thick: the load is too "
                             "large for this material and shape",
                             rim.towards_ground, thickness)};
}

template <int dim>
std::optional<Failure> no_contact(const RollingModel<dim>& model, const ReducedContact<dim>& contact,
                                  const ContactState<dim>& state) {
  if (std::ranges::any_of(state.augmented, [](const Vec<dim>& z) { return z[0] < 0; })) return {};
  Failure failure = lifted(model);
  failure.detail += fmt::format(
      ", or more grid.tread_levels: the nearest of the contact's points is {:.4g} m above "
      "the ground",
      smallest_gap(contact, state));
  return failure;
}

template <int dim>
Failure contact_failure(const ContactFailure& failure, const RollingModel<dim>& model,
                        const ReducedContact<dim>& contact) {
  if (failure.limit && failure.reason == FailureReason::sliding) return sliding(*failure.limit, model);
  if (failure.reason == FailureReason::no_contact) return lifted(model);
  if (failure.reason == FailureReason::newton_stalled) return unexplained(failure, model, contact);
  return failure;
}

template decltype(contact_failure<2>) contact_failure<2>;
template decltype(rim_under_ground<2>) rim_under_ground<2>;
template decltype(no_contact<2>) no_contact<2>;
template decltype(contact_failure<3>) contact_failure<3>;
template decltype(rim_under_ground<3>) rim_under_ground<3>;
template decltype(no_contact<3>) no_contact<3>;

}  // namespace wheelwright
