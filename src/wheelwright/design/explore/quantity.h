#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/units.h"
#include "wheelwright/case/case.h"
#include "wheelwright/case/quantity_needs.h"

namespace wheelwright {

/// A quantity by which designs are ranked.
struct RankedQuantity {
  std::string word;   ///< on the command line, e.g. "run_out"
  std::string name;   ///< in case files; the command line accepts it too
  std::string label;  ///< for people
  ShownUnit shown;
  std::string key;  ///< in summary.json
  bool is_larger_better;
  bool is_of_evenness;  ///< whether it measures how evenly the wheel rolls
  bool is_of_shape;     ///< the same under every load

  bool is_called(std::string_view text) const { return text == word || text == name; }
};

/// Of designs in that dimension.
RankedQuantity ranked(const Quantity& quantity, int dimension);

/// All built-in ones, of 2D wheels.
const std::vector<RankedQuantity>& ranked_quantities();

/// The quantities that the designs of a case have. They contain those of its layers and of its program, and
/// lack those that need constants of materials which the case does not give.
std::vector<RankedQuantity> ranked_quantities(const Case& c);

/// The constants of materials that a case does not give and the built-in one with that word or name needs.
std::vector<Need> unmet_needs_of_ranked(const Case& c, std::string_view word);

/// The built-in one of 2D wheels with that word or name, or null.
const RankedQuantity* find_quantity(std::string_view word);

}  // namespace wheelwright
