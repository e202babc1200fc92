#pragma once

#include <optional>

namespace wheelwright {

/// How a rolling wheel gives its heat away. Temperatures are in degrees Celsius, coefficients of convection
/// [W/(m^2 K)] are means over a turn; 0: the surface is insulated.
struct Cooling {
  double ambient_temperature = 20;              ///< of the air
  std::optional<double> rim_temperature = {};   ///< absent: the rim is insulated
  double tread = 0, holes = 0, side_faces = 0;  ///< coefficients of convection

  /// Whether any heat can leave.
  bool any() const { return rim_temperature || tread > 0 || holes > 0 || side_faces > 0; }

  /// The lowest temperature that a warmed wheel can have.
  double coldest() const {
    return rim_temperature && *rim_temperature < ambient_temperature ? *rim_temperature : ambient_temperature;
  }
  /// Of the rim over the ambient temperature [K]; 0 if it is insulated.
  double rim_rise() const { return rim_temperature ? *rim_temperature - ambient_temperature : 0; }
};

}  // namespace wheelwright
