#include "wheelwright/run/bound_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/optimize/constraints.h"
#include "wheelwright/run/bounded_functions.h"
#include "wheelwright/run/predicted_deformation.h"
#include "wheelwright/run/study.h"

namespace wheelwright {
namespace {

/// Whether a quantity is per metre of width in 2D, and hardly differs by an order of magnitude between wheels
/// for the same load.
bool is_told_apart(Quantity quantity) {
  switch (quantity) {
    case Quantity::strain_energy:
    case Quantity::mass:
    case Quantity::stiffness:
    case Quantity::tangential_stiffness:
    case Quantity::torsional_stiffness:
    case Quantity::radial_force:
      return true;
    default:
      return false;
  }
}

std::string warning(const BoundState& bound, Quantity quantity, double width) {
  return fmt::format(
      "constraint {} = {:.4g}: in 2D bounds are per metre of width, so that this is {:.4g} {} on the whole "
      "width "
      "of {:g} m, where the initial shape has {:.4g} {}; for {:.4g} {} on the whole width write {:.6g}",
      bound.name, bound.bound, bound.bound * width, unit<3>(kind(quantity)), width, bound.value * width,
      unit<3>(kind(quantity)), bound.bound, unit<3>(kind(quantity)), bound.bound / width);
}

}  // namespace

std::vector<std::string> bound_warnings(const Case& c) {
  if (c.wheel.dimension != 2 || c.constraints.empty()) return {};
  const auto study = make_study<2>(on_predicting_grid(c));
  if (!study) return {};
  const auto evaluated = evaluate_of(*study)({study->initial, nullptr}, nullptr);
  if (!evaluated) return {};
  std::vector<std::string> result;
  for (const BoundState& bound : bound_states(evaluated->evaluation, {})) {
    const Quantity quantity = quantity_of(bound.name);
    const double ratio = bound.bound / bound.value;
    if (is_told_apart(quantity) && ratio > 0 &&
        std::abs(std::log(ratio / c.wheel.width)) < std::abs(std::log(ratio)))
      result.push_back(warning(bound, quantity, c.wheel.width));
  }
  return result;
}

}  // namespace wheelwright
