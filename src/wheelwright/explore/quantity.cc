#include "wheelwright/explore/quantity.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// Designs are 2D wheels.
constexpr ShownUnit in(UnitKind kind) { return shown_unit(kind, 2); }

}  // namespace

const std::vector<RankedQuantity>& ranked_quantities() {
  static const std::vector<RankedQuantity> all{
      {"stiffness", "stiffness", in(UnitKind::stiffness), "stiffness_N_per_m", true, false},
      {"strain_energy", "strain energy per position", in(UnitKind::energy), "strain_energy_J_per_m", false,
       false},
      {"mass", "volume, which the mass is proportional to", in(UnitKind::ratio), "volume_fraction", false,
       false},
      {"run_out", "run-out", micrometres, "run_out_m", false, true},
      {"force_variation", "radial force variation", in(UnitKind::force), "force_variation_N", false, true},
      {"peak_pressure", "peak contact pressure", in(UnitKind::stress), "peak_pressure_Pa", false, true},
      {"peak_stress", "peak von Mises stress", in(UnitKind::stress), "peak_von_mises_Pa", false, false},
      {"strain", "largest strain", in(UnitKind::ratio), "largest_strain", false, false},
      {"roughness", "roughness of the edges", in(UnitKind::turns), "roughness_turns", false, false},
  };
  return all;
}

const RankedQuantity* find_quantity(std::string_view word) {
  const auto& all = ranked_quantities();
  const auto found = std::ranges::find(all, word, &RankedQuantity::word);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
