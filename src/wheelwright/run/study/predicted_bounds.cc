#include "wheelwright/run/study/predicted_bounds.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/run/study/predicted_deformation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

/// Whether a quantity is per metre of width in 2D, and varies by less than an order of magnitude between
/// wheels for the same load, so that a value of the whole width is recognized.
bool is_distinguishable(const Quantity& quantity) {
  return is_per_width(kind(quantity)) && quantity->of != Positions::all;
}

std::string warning(const BoundState& bound, const Quantity& quantity, const Wheel& wheel) {
  return fmt::format(
      "constraint {} = {:.4g}: plain numbers are per metre of width in 2D, so this is {} on the whole width "
      "of {:g} m, where the initial shape has {}; write a bound on the whole width with its unit: \"{}\"",
      bound.name, bound.bound, shown_text(quantity, bound.bound, wheel), wheel.width,
      shown_text(quantity, bound.value, wheel), shown_text(quantity, bound.bound / wheel.width, wheel));
}

}  // namespace

PredictedBounds predicted_bounds(const Case& c) {
  if (c.wheel.dimension != 2 || c.constraints.empty()) return {};
  const auto study = make_study<2>(on_predicting_grid(c));
  if (!study) return {};
  const auto evaluated = evaluate_of(*study)({study->initial, nullptr}, nullptr);
  if (!evaluated) return {};
  PredictedBounds result;
  for (const BoundState& bound : bound_states(evaluated->evaluation, {})) {
    const Quantity& quantity = study->function(bound.name).quantity;
    const double ratio = bound.bound / bound.value;
    if (is_distinguishable(quantity) && ratio > 0 &&
        std::abs(std::log(ratio / c.wheel.width)) < std::abs(std::log(ratio)))
      result.warnings.push_back(warning(bound, quantity, c.wheel));
    if (!bound.is_kept())
      result.note += fmt::format("  {:<22}{}, on {}\n", "initial shape", text(bound, study->grid()),
                                 grid_text(study->source));
  }
  return result;
}

}  // namespace wheelwright
