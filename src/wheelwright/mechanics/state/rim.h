#pragma once

#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// A rigid motion of the rim (4.3), in the ground frame. It costs no energy: u = v + motion with v = 0 on the
/// rim.
struct RimMotion {
  double towards_ground = 0;  ///< alpha_D [m]
  double along_ground = 0;    ///< towards larger azimuth [m]
  double rotation = 0;        ///< about the axle, towards larger azimuth [rad]
  double along_axle = 0;      ///< towards larger z; when dim = 3 [m]
};

/// The forces that do work on those motions [N/m and N when dim = 2].
struct RimForce {
  double towards_ground = 0, along_ground = 0, torque = 0, along_axle = 0;
};

/// A free motion of the rim, and the force on the rim that does work on it.
struct FreeMotion {
  RimMotion direction;
  double force;
};

/// The support and loads of the rim: its motion is the prescribed one plus any combination of the free
/// motions.
struct RimControl {
  RimMotion prescribed;
  std::vector<FreeMotion> free;
};

/// a + factor b.
inline RimMotion combined(const RimMotion& a, double factor, const RimMotion& b) {
  return {a.towards_ground + factor * b.towards_ground, a.along_ground + factor * b.along_ground,
          a.rotation + factor * b.rotation, a.along_axle + factor * b.along_axle};
}

inline RimForce sum(const RimForce& a, const RimForce& b) {
  return {a.towards_ground + b.towards_ground, a.along_ground + b.along_ground, a.torque + b.torque,
          a.along_axle + b.along_axle};
}

inline RimForce scaled(double factor, const RimForce& a) {
  return {factor * a.towards_ground, factor * a.along_ground, factor * a.torque, factor * a.along_axle};
}

/// The work of a force on a motion.
inline double work(const RimForce& force, const RimMotion& motion) {
  return force.towards_ground * motion.towards_ground + force.along_ground * motion.along_ground +
         force.torque * motion.rotation + force.along_axle * motion.along_axle;
}

/// The displacement of a point that moves with the rim, in the ground frame: component 0 is towards the
/// ground, 1 along it, 2 across. `position` is relative to the axle, in the same frame. The wheel rotates
/// about the frame's axis 2, which is the axle where the wheel stands upright.
template <int dim>
Vec<dim> displacement(const RimMotion& motion, const Vec<dim>& position) {
  Vec<dim> u{};
  u[0] = motion.towards_ground - motion.rotation * position[1];
  u[1] = motion.along_ground + motion.rotation * position[0];
  if constexpr (dim == 3) u[2] = motion.along_axle;
  return u;
}

/// The resultant of a force at a point.
template <int dim>
RimForce resultant(const Vec<dim>& force, const Vec<dim>& position) {
  return {force[0], force[1], force[1] * position[0] - force[0] * position[1], dim == 3 ? force[dim - 1] : 0};
}

}  // namespace wheelwright
