#include "wheelwright/design/explore/quantity.h"

#include <algorithm>
#include <array>

#include "wheelwright/case/layers.h"

namespace wheelwright {

/// Designs are 2D wheels. Lengths of good designs that differ in evenness differ by micrometres.
RankedQuantity ranked(const Quantity& quantity) {
  const bool is_fine = quantity->is_of_evenness && kind(quantity) == UnitKind::length;
  return {.word = of_part(quantity->ranked_as.empty() ? quantity->name : quantity->ranked_as, quantity->part),
          .label = label(quantity),
          .shown = is_fine ? micrometres : shown_unit(kind(quantity), 2),
          .key = number_key(quantity, 2),
          .is_larger_better = quantity->is_larger_better,
          .is_of_evenness = quantity->is_of_evenness,
          .is_of_shape = quantity->of == Positions::none};
}

namespace {

constexpr std::array names_of_ranked{
    "stiffness",      "strain_energy",   "volume_fraction",    "mass",
    "run_out",        "force_variation", "peak_pressure",      "peak_von_mises",
    "largest_strain", "roughness",       "rolling_resistance", "peak_temperature"};

/// Whether a case gives the constants of the materials, and the speed and cooling, that a quantity needs.
bool has_what_it_needs(const Case& c, const Quantity& quantity) {
  return std::ranges::all_of(quantity->needs, [&](Input input) {
    return (input != Input::density || has_density(c, quantity->part)) &&
           (input != Input::loss_factor || has_loss_factor(c, quantity->part)) &&
           (input != Input::all_loss_factors || has_loss_factor(c)) &&
           (input != Input::conductivity || has_conductivity(c)) && (input != Input::cooling || cooling(c)) &&
           (input != Input::speed || c.load.speed > 0);
  });
}

}  // namespace

const std::vector<RankedQuantity>& ranked_quantities() {
  static const std::vector<RankedQuantity> all = [] {
    std::vector<RankedQuantity> quantities;
    for (const char* name : names_of_ranked) quantities.push_back(ranked(built_in(name)));
    return quantities;
  }();
  return all;
}

std::vector<RankedQuantity> ranked_quantities(const Case& c) {
  std::vector<RankedQuantity> quantities;
  const auto add = [&](const Quantity& quantity) {
    if (has_what_it_needs(c, quantity)) quantities.push_back(ranked(quantity));
  };
  for (const char* name : names_of_ranked) add(built_in(name));
  for (const std::string& layer : names_of_layers(c))
    for (const char* name : names_of_ranked)
      if (built_in(name)->has_parts) add(in_layer(c, built_in(name), layer));
  for (const Quantity& own : c.vocabulary.quantities.own()) add(own);
  return quantities;
}

const RankedQuantity* find_quantity(std::string_view word) {
  const auto& all = ranked_quantities();
  const auto found = std::ranges::find(all, word, &RankedQuantity::word);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
