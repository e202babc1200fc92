#pragma once

#include <wheelwright/case/own_load.h>
#include <wheelwright/mechanics/state/rolling_model.h>

#include <cmath>
#include <numbers>

/// load.slope: the angle of a road that climbs towards larger azimuth. The vehicle then pulls the axle back
/// with the load times the tangent of the slope.
inline wheelwright::OwnLoadKey slope() {
  return {.name = "slope",
          .unit = "deg",
          .meaning = "angle by which the road climbs towards larger azimuth",
          .range = wheelwright::between(-30, 30),
          .factor = std::numbers::pi / 180,
          .effect = []<int dim>(double angle, const wheelwright::RollingModel<dim>& wheel,
                                wheelwright::WheelLoads<dim>& loads) {
            loads.horizontal_force -= wheel.load * std::tan(angle);
          }};
}
