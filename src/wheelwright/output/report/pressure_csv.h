#pragma once

#include <filesystem>
#include <span>

namespace wheelwright {

/// The contact at one quadrature point of the tread, for one load position. Positive azimuths, x and friction
/// point along the ground towards larger azimuth of the body frame.
struct ContactPoint {
  int position;               ///< load position
  double azimuth;             ///< of the unloaded tread, from the contact point [rad]
  double x;                   ///< along the ground, from the point below the axle [m]
  double weight;              ///< length of tread represented by the point [m], in 3D its area [m^2]
  double pressure;            ///< contact pressure of the law, >= 0 [Pa]
  double friction;            ///< the ground's tangential traction on the tread, of the law [Pa]
  double normal_stress;       ///< sigma_n of the displacement, tension positive [Pa]
  double gap;                 ///< distance to the ground in the deformed state, negative: penetration [m]
  double z = 0;               ///< along the axle, from the middle of the width; in 3D [m]
  double axial_friction = 0;  ///< the traction along the axle; in 3D [Pa]
  int cell = 0;               ///< at the tread, in which the point lies; counted around the ring
};

/// Writes one row per point, in the order given, with the azimuth in degrees; atomically. The sum of weight
/// times pressure over a position is the ground's force, per metre of width when dim = 2. Throws OutputError.
template <int dim>
void write_pressure_csv(const std::filesystem::path& path, std::span<const ContactPoint> points);

}  // namespace wheelwright
