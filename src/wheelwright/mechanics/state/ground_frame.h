#pragma once

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

/// The frame of the ground as seen from a frame of the body whose first axis is radial: component 0 along
/// n_y, into the ground, 1 along the ground, and 2 across. The wheel leans by the camber: its side at larger
/// z is closer to the ground. Where the ground is not flat, its normal n at a point is tilted: the frame of
/// the contact has component 0 along n and 1 along the ground there.
struct GroundFrame {
  double angle;       ///< azimuth of the body's frame minus that of the ground [rad]
  double camber = 0;  ///< when dim = 3 [rad]
  double tilt = 0;    ///< angle from n_y to n, towards larger azimuth [rad]

  template <int dim>
  Vec<dim> to_ground(const Vec<dim>& v) const {
    return leaned<dim>(rotated<dim>(v, angle), camber);
  }
  template <int dim>
  Vec<dim> to_body(const Vec<dim>& v) const {
    return rotated<dim>(leaned<dim>(v, -camber), -angle);
  }

  template <int dim>
  Vec<dim> ground_to_contact(const Vec<dim>& v) const {
    return tilt == 0 ? v : rotated<dim>(v, -tilt);
  }
  template <int dim>
  Vec<dim> contact_to_ground(const Vec<dim>& v) const {
    return tilt == 0 ? v : rotated<dim>(v, tilt);
  }

  /// From the body's frame to that of the contact, and back.
  template <int dim>
  Vec<dim> to_contact(const Vec<dim>& v) const {
    return ground_to_contact<dim>(to_ground<dim>(v));
  }
  template <int dim>
  Vec<dim> contact_to_body(const Vec<dim>& v) const {
    return to_body<dim>(contact_to_ground<dim>(v));
  }

 private:
  template <int dim>
  static Vec<dim> leaned(Vec<dim> v, double by) {
    if constexpr (dim == 3)
      if (by != 0)
        v = {std::cos(by) * v[0] + std::sin(by) * v[2], v[1], std::cos(by) * v[2] - std::sin(by) * v[0]};
    return v;
  }
};

}  // namespace wheelwright
