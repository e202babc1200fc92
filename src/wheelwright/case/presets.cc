#include "wheelwright/case/presets.h"

#include <algorithm>
#include <array>

namespace wheelwright {

namespace {

constexpr std::array<Preset, 9> all{{
    {"paper16", "the wheel of the paper with 16 holes", R"(# The wheel of the paper: 16 round holes.

title = "16 holes"

[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04

[optimizer]
rim_band = 0.005
tread_band = 0.01
)"},
    {"paper48", "the wheel of the paper with 48 holes",
     R"(# The wheel of the paper with two rings of 24 holes.

title = "48 holes"

[wheel]
sectors = 24

[[holes.ring]]
count = 24
center_radius = 0.235
radius = 0.0231

[[holes.ring]]
count = 24
center_radius = 0.305
radius = 0.0231

[optimizer]
rim_band = 0.005
tread_band = 0.01
)"},
    {"paper108", "the wheel of the paper with 108 holes",
     R"(# The wheel of the paper with three rings of 36 holes.

title = "108 holes"

[wheel]
sectors = 36

[[holes.ring]]
count = 36
center_radius = 0.2233
radius = 0.0154

[[holes.ring]]
count = 36
center_radius = 0.27
radius = 0.0154

[[holes.ring]]
count = 36
center_radius = 0.3167
radius = 0.0154

[grid]
radial_cells = 42
angular_cells = 576

[optimizer]
smoothing = 0.1  # keeps the edges of small holes smooth
rim_band = 0.00333333333333
tread_band = 0.00666666666667
)"},
    {"paper16-3d", "the wheel of the paper with 16 holes, in three dimensions",
     R"(# The wheel of the paper: 16 round holes, in three dimensions.

title = "16 holes, 3D"

[wheel]
dimension = 3

[load]
positions = 4

[contact]
quadrature_points = 3

[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04

[grid]
radial_cells = 12
angular_cells = 144
axial_cells = 4

[optimizer]
smoothing = 0.1  # keeps the edges smooth on a coarse grid
rim_band = 0.0117
tread_band = 0.0234
)"},
    {"caster", "a small wheel of polyurethane, for 80 kg",
     R"(# A caster of 125 mm: a tyre of polyurethane with slots on a rigid hub.

title = "Caster"

[wheel]
inner_radius = 0.025
outer_radius = 0.0625
width = 0.032
sectors = 12

[material]
youngs_modulus = 60e6
poissons_ratio = 0.45
plane = "stress"

[load]
mass = 80

[[shape.slot]]
count = 12
center_radius = 0.043
length = 0.022
width = 0.010

[grid]
radial_cells = 28
angular_cells = 288
)"},
    {"tram", "a solid steel wheel of a tram, for 50 kN",
     R"(# The disc of a tram's wheel, solid steel without holes. To optimize it, add holes or shapes.

title = "Solid steel tram wheel"

[wheel]
inner_radius = 0.12
outer_radius = 0.33
width = 0.1
sectors = 24

[material]
youngs_modulus = 210e9
poissons_ratio = 0.3

[load]
force = 50e3

[grid]
radial_cells = 28
angular_cells = 384
)"},
    {"straight-spokes", "an airless tyre with 24 straight spokes",
     R"(# An airless tyre: 24 straight spokes between two bands.

title = "Straight spokes"

[wheel]
sectors = 24

[material]
youngs_modulus = 200e6
poissons_ratio = 0.4

[[shape.annulus]]

[[shape.spoke]]
count = 24
thickness = 0.015

[grid]
radial_cells = 28
angular_cells = 480
)"},
    {"curved-spokes", "an airless tyre with 24 curved spokes",
     R"(# An airless tyre: 24 curved spokes between two bands.

title = "Curved spokes"

[wheel]
sectors = 24

[material]
youngs_modulus = 200e6
poissons_ratio = 0.4

[[shape.annulus]]

[[shape.spoke]]
kind = "curved"
count = 24
thickness = 0.015
angle = 12
bend = 40

[grid]
radial_cells = 28
angular_cells = 480
)"},
    {"bicycle", "a wheel of a bicycle cast in one piece, with pairs of spokes",
     R"(# A wheel of a bicycle, cast in one piece: ten pairs of spokes lean to both sides.

title = "Bicycle"

[wheel]
inner_radius = 0.04
outer_radius = 0.31
width = 0.03
sectors = 10

[material]
youngs_modulus = 3e9
poissons_ratio = 0.38
plane = "stress"

[load]
mass = 60

[[shape.annulus]]

[[shape.spoke]]
kind = "pair"
count = 10
thickness = 0.018
spread = 14
angle = 11

[grid]
radial_cells = 36
angular_cells = 480
)"},
}};

}  // namespace

std::span<const Preset> presets() { return all; }

const Preset* find_preset(std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Preset& preset) { return preset.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace wheelwright
