#include "wheelwright/explore/quantity.h"

#include <algorithm>

namespace wheelwright {

const std::vector<RankedQuantity>& ranked_quantities() {
  static const std::vector<RankedQuantity> all{
      {"stiffness", "stiffness", "N/mm", 1e-3, "stiffness_N_per_m", true, false},
      {"strain_energy", "strain energy per position", "J/m", 1, "strain_energy_J_per_m", false, false},
      {"mass", "volume, which the mass is proportional to", "%", 100, "volume_fraction", false, false},
      {"run_out", "run-out", "um", 1e6, "run_out_m", false, true},
      {"force_variation", "radial force variation", "N", 1, "force_variation_N", false, true},
      {"peak_pressure", "peak contact pressure", "MPa", 1e-6, "peak_pressure_Pa", false, true},
      {"peak_stress", "peak von Mises stress", "MPa", 1e-6, "peak_von_mises_Pa", false, false},
      {"strain", "largest strain", "%", 100, "largest_strain", false, false},
      {"roughness", "roughness of the edges", "turns below a cell", 1, "roughness_turns", false, false},
  };
  return all;
}

const RankedQuantity* find_quantity(std::string_view word) {
  const auto& all = ranked_quantities();
  const auto found = std::ranges::find(all, word, &RankedQuantity::word);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
