#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "wheelwright/mechanics/state/contact_patch.h"

namespace wheelwright {

/// One load position, in terms of the rim and the ground. Forces are per metre of width when dim = 2. Forces
/// and motions along the ground, torques and rotations are positive towards larger azimuth.
struct ContactSummary {
  double travel;                   ///< of the rim towards the ground (ContactPatch::travel) [m]
  double radial_force;             ///< of the ground on the tread [N/m]
  double peak_pressure;            ///< largest contact pressure at the quadrature points [Pa]
  double patch_length;             ///< of all that touches, along the ground, without gaps between [m]
  double patch_extent;             ///< from the first to the last contact, with the gaps [m]
  double friction_force = 0;       ///< of the ground on the tread, along the ground [N/m]
  double peak_friction = 0;        ///< largest size of its traction along the ground [Pa]
  double travel_along_ground = 0;  ///< of the rim [m]
  double wind_up = 0;              ///< the angle by which the rim turns [rad]
  double descent = 0;              ///< of the axle, from its place with the wheel at rest without load [m]
  std::optional<double> stiffness = {};  ///< ContactPatch::stiffness [Pa]
};

/// Each lobe of the patch, a part without gaps, ends where the square of the pressure, extrapolated from its
/// outer points, is zero. Across the width, a place along the ground touches where any of its points does.
template <int dim>
ContactSummary contact_summary(const ContactPatch<dim>& contact);

/// The summary of a position's mirror image: forces and motions along the ground, and rotations, have the
/// opposite sign.
ContactSummary mirror_image(ContactSummary position);

/// The variation of a quantity while the wheel rolls.
struct RollingVariation {
  double mean, minimum, maximum;
  std::vector<double> harmonics;  ///< amplitudes of N_s, 2 N_s, ... waves per revolution

  double peak_to_peak() const { return maximum - minimum; }
};

/// From values at N load positions that divide one sector evenly: only harmonics below N / 2 can be
/// distinguished.
RollingVariation rolling_variation(std::span<const double> values);

/// The evenness of rolling in single numbers.
struct RollingMeasures {
  double mean_travel;      ///< [m]
  double run_out;          ///< peak to peak of the axle's height at fixed load [m]
  double peak_pressure;    ///< maximum over the positions [Pa]
  double pressure_spread;  ///< of the positions' peaks: (maximum - minimum) / mean
};

/// The name of the quantity that each of them is: what history.csv records in this order.
inline constexpr std::array<std::pair<std::string_view, double RollingMeasures::*>, 4> rolling_quantities{
    {{"mean_travel", &RollingMeasures::mean_travel},
     {"run_out", &RollingMeasures::run_out},
     {"peak_pressure", &RollingMeasures::peak_pressure},
     {"pressure_spread", &RollingMeasures::pressure_spread}}};

RollingMeasures rolling_measures(std::span<const ContactSummary> positions);

}  // namespace wheelwright
