#pragma once

#include <filesystem>
#include <span>

namespace wheelwright {

/// The contact at one point of the tread, for one load position.
struct ContactPoint {
  int position;          ///< load position
  double azimuth;        ///< from the contact point, counter-clockwise [rad]
  double x;              ///< along the ground, from the point below the axle [m]
  double pressure;       ///< contact pressure of the law, >= 0 [Pa]
  double normal_stress;  ///< sigma_n of the displacement, tension positive [Pa]
  double gap;            ///< distance to the ground in the deformed state, negative: penetration [m]
};

/// Writes one row per point, in the order given, with the azimuth in degrees; atomically. Throws OutputError.
void write_pressure_csv(const std::filesystem::path& path, std::span<const ContactPoint> points);

}  // namespace wheelwright
