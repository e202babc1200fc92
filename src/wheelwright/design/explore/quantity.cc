#include "wheelwright/design/explore/quantity.h"

#include <algorithm>
#include <array>

#include "wheelwright/case/layers.h"

namespace wheelwright {

// Lengths of good designs that differ in evenness differ by micrometres.
RankedQuantity ranked(const Quantity& quantity, int dimension) {
  const bool is_fine = quantity->is_of_evenness && kind(quantity) == UnitKind::length;
  return {.word = of_part(quantity->ranked_as.empty() ? quantity->name : quantity->ranked_as, quantity->part),
          .name = of_part(quantity->name, quantity->part),
          .label = label(quantity),
          .shown = is_fine ? micrometres : shown_unit(kind(quantity), dimension),
          .key = number_key(quantity, dimension),
          .is_larger_better = quantity->is_larger_better,
          .is_of_evenness = quantity->is_of_evenness,
          .is_of_shape = quantity->of == Positions::none};
}

namespace {

constexpr std::array names_of_ranked{
    "stiffness",          "strain_energy",       "volume_fraction", "mass",           "run_out",
    "force_variation",    "peak_pressure",       "peak_von_mises",  "largest_strain", "roughness",
    "rolling_resistance", "fatigue_utilization", "peak_temperature"};

}  // namespace

const std::vector<RankedQuantity>& ranked_quantities() {
  static const std::vector<RankedQuantity> all = [] {
    std::vector<RankedQuantity> quantities;
    for (const char* name : names_of_ranked) quantities.push_back(ranked(built_in(name), 2));
    return quantities;
  }();
  return all;
}

std::vector<RankedQuantity> ranked_quantities(const Case& c) {
  std::vector<RankedQuantity> quantities;
  const auto add = [&](const Quantity& quantity) {
    if (unmet_needs_of_materials(c, quantity).empty())
      quantities.push_back(ranked(quantity, c.wheel.dimension));
  };
  for (const char* name : names_of_ranked) add(built_in(name));
  for (const std::string& layer : names_of_layers(c))
    for (const char* name : names_of_ranked)
      if (built_in(name)->has_parts) add(in_layer(c, built_in(name), layer));
  for (const Quantity& own : c.vocabulary.quantities.own()) add(own);
  return quantities;
}

std::vector<Need> unmet_needs_of_ranked(const Case& c, std::string_view word) {
  for (const char* name : names_of_ranked)
    if (ranked(built_in(name), c.wheel.dimension).is_called(word))
      return unmet_needs_of_materials(c, built_in(name));
  return {};
}

const RankedQuantity* find_quantity(std::string_view word) {
  const auto& all = ranked_quantities();
  const auto found = std::ranges::find_if(all, [&](const auto& known) { return known.is_called(word); });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
