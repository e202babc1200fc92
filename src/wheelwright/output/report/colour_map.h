#pragma once

#include <array>
#include <string>

namespace wheelwright {

/// Colour of t in [0, 1] on the viridis map (perceptually even, readable in grey and by the colour-blind), as
/// "#rrggbb"; t outside is clamped, NaN is grey.
std::string viridis(double t);

/// The same colour as red, green and blue in [0, 255].
std::array<int, 3> viridis_rgb(double t);

/// Colour of t in [-1, 1], from blue over white to red; t outside is clamped, NaN is grey.
std::string blue_to_red(double t);

}  // namespace wheelwright
