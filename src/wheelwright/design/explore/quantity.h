#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/units.h"
#include "wheelwright/quantities/functionals/quantities.h"

namespace wheelwright {

/// A quantity by which designs are ranked.
struct RankedQuantity {
  std::string word;   ///< on the command line, e.g. "run_out"
  std::string label;  ///< for people
  ShownUnit shown;
  std::string key;  ///< in summary.json
  bool is_larger_better;
  bool is_of_evenness;  ///< whether it measures how evenly the wheel rolls
  bool is_of_shape;     ///< the same under every load
};

RankedQuantity ranked(const Quantity& quantity);

/// The mass itself, for wheels of several materials; the word `mass` otherwise means the volume, to which it
/// is proportional.
RankedQuantity ranked_mass();

/// All built-in ones.
const std::vector<RankedQuantity>& ranked_quantities();

/// The one with that word or name, or null.
const RankedQuantity* find_quantity(std::string_view word);

}  // namespace wheelwright
