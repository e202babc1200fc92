#include "wheelwright/design/explore/quantity.h"

#include <algorithm>

namespace wheelwright {

/// Designs are 2D wheels. Lengths of good designs that differ in evenness differ by micrometres.
RankedQuantity ranked(const Quantity& quantity) {
  const bool is_fine = quantity->is_of_evenness && kind(quantity) == UnitKind::length;
  return {.word = quantity->ranked_as.empty() ? name(quantity) : quantity->ranked_as,
          .label = label(quantity),
          .shown = is_fine ? micrometres : shown_unit(kind(quantity), 2),
          .key = number_key(quantity, 2),
          .is_larger_better = quantity->is_larger_better,
          .is_of_evenness = quantity->is_of_evenness,
          .is_of_shape = quantity->of == Positions::none};
}

RankedQuantity ranked_mass() {
  return {.word = "mass",
          .label = "mass",
          .shown = {"kg", 1},
          .key = "mass_kg",
          .is_larger_better = false,
          .is_of_evenness = false,
          .is_of_shape = true};
}

const std::vector<RankedQuantity>& ranked_quantities() {
  static const std::vector<RankedQuantity> all = [] {
    std::vector<RankedQuantity> quantities;
    for (const char* name : {"stiffness", "strain_energy", "volume_fraction", "run_out", "force_variation",
                             "peak_pressure", "peak_von_mises", "largest_strain", "roughness"})
      quantities.push_back(ranked(built_in(name)));
    std::ranges::find(quantities, "mass", &RankedQuantity::word)->label =
        "volume, which the mass is proportional to";
    return quantities;
  }();
  return all;
}

const RankedQuantity* find_quantity(std::string_view word) {
  const auto& all = ranked_quantities();
  const auto found = std::ranges::find(all, word, &RankedQuantity::word);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
