#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "wheelwright/base/units.h"

namespace wheelwright {

/// The scalars that describe a shape: the objective and its terms, what history.csv records besides, and what
/// is computed where it is asked for.
enum class Quantity {
  objective,
  strain_energy,
  uniformity_annulus,
  uniformity_dual,
  uniformity_l2,
  mean_travel,
  run_out,
  peak_pressure,
  pressure_spread,
  volume_fraction,
  peak_von_mises,
  peak_von_mises_inside,
  mass,
  perimeter,
  travel,
  stiffness,
  tangential_stiffness,
  torsional_stiffness,
  radial_force,
  run_out_harmonic,
  force_variation,
  force_variation_harmonic,
  minimum_wall,
  minimum_gap,
};

struct QuantityDescription {
  std::string_view name;  ///< the word for case files and history.csv
  UnitKind kind;
};

/// In the order of the enumerators: the one place for names and units.
inline constexpr std::array<QuantityDescription, 24> quantity_descriptions{
    {{"objective", UnitKind::energy},
     {"strain_energy", UnitKind::energy},
     {"uniformity_annulus", UnitKind::energy},
     {"uniformity_dual", UnitKind::energy},
     {"uniformity_l2", UnitKind::energy},
     {"mean_travel", UnitKind::length},
     {"run_out", UnitKind::length},
     {"peak_pressure", UnitKind::stress},
     {"pressure_spread", UnitKind::ratio},
     {"volume_fraction", UnitKind::ratio},
     {"peak_von_mises", UnitKind::stress},
     {"peak_von_mises_inside", UnitKind::stress},
     {"mass", UnitKind::mass},
     {"perimeter", UnitKind::length},
     {"travel", UnitKind::length},
     {"stiffness", UnitKind::stiffness},
     {"tangential_stiffness", UnitKind::stiffness},
     {"torsional_stiffness", UnitKind::torsional_stiffness},
     {"radial_force", UnitKind::force},
     {"run_out_harmonic", UnitKind::length},
     {"force_variation", UnitKind::force},
     {"force_variation_harmonic", UnitKind::force},
     {"minimum_wall", UnitKind::length},
     {"minimum_gap", UnitKind::length}}};

constexpr std::string_view name(Quantity quantity) {
  return quantity_descriptions[static_cast<std::size_t>(quantity)].name;
}
constexpr UnitKind kind(Quantity quantity) {
  return quantity_descriptions[static_cast<std::size_t>(quantity)].kind;
}

/// Their names alone, in the order of the enumerators.
inline constexpr auto quantity_names = [] {
  std::array<std::string_view, quantity_descriptions.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = quantity_descriptions[i].name;
  return names;
}();

}  // namespace wheelwright
