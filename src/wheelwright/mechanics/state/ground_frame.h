#pragma once

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

/// The frame of the ground as seen from a frame of the body whose first axis is radial: component 0 along
/// n_y, into the ground, 1 along the ground, and 2 across. The wheel leans by the camber: its side at larger
/// z is closer to the ground.
struct GroundFrame {
  double angle;       ///< azimuth of the body's frame minus that of the ground [rad]
  double camber = 0;  ///< when dim = 3 [rad]

  template <int dim>
  Vec<dim> to_ground(const Vec<dim>& v) const {
    return leaned<dim>(rotated<dim>(v, angle), camber);
  }
  template <int dim>
  Vec<dim> to_body(const Vec<dim>& v) const {
    return rotated<dim>(leaned<dim>(v, -camber), -angle);
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
