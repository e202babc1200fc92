#include "wheelwright/run/results/bounded_peaks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "wheelwright/case/layers.h"
#include "wheelwright/quantities/functionals/quantity.h"

namespace wheelwright {
namespace {

/// Whether a bound is on what a load position between the computed ones may exceed.
bool is_on_a_peak(const Constraint& constraint) {
  const QuantityRow& row = *constraint.quantity;
  return row.of == Positions::each && (row.is_maximum || constraint.over != OverPositions::mean);
}

}  // namespace

std::string bounded_peaks(const Case& c) {
  std::vector<std::string> names;
  for (const Constraint& constraint : c.constraints)
    if (const std::string one = name(quantity_of(c, constraint));
        is_on_a_peak(constraint) && std::ranges::find(names, one) == names.end())
      names.push_back(one);
  if (names.empty()) return "";
  return fmt::format(
      "Bounds on {} apply at the load positions, {} per sector; between these they may be violated: "
      "`wheelwright "
      "analyze` computes 64 positions.",
      fmt::join(names, ", "), c.load.positions);
}

}  // namespace wheelwright
