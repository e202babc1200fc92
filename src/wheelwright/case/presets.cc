#include "wheelwright/case/presets.h"

#include <algorithm>
#include <array>

namespace wheelwright {

namespace {

constexpr std::array<Preset, 17> all{{
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
    {"caster-3d", "a small wheel of polyurethane from a mould, for 25 kg, in three dimensions",
     R"(# A caster of 125 mm in three dimensions, with free side faces: a tyre of polyurethane on a rigid hub, cast in
# a mould of two halves with a draft of 2 degrees.

title = "Caster in 3D"

[wheel]
dimension = 3
inner_radius = 0.025
outer_radius = 0.0625
width = 0.032
sectors = 12

[material]
youngs_modulus = 60e6
poissons_ratio = 0.45

[load]
mass = 25
positions = 2

[contact]
quadrature_points = 3

[[shape.slot]]
count = 12
center_radius = 0.043
length = 0.022
width = 0.011

[grid]
radial_cells = 12
angular_cells = 144
axial_cells = 4
tread_levels = 1

[optimizer]
smoothing = 0.1  # keeps the edges smooth on a coarse grid
made = "moulded"
draft = 2
rim_band = 0.0033
tread_band = 0.0064
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
    {"soft-spokes", "an airless wheel of a soft TPU, for 100 kg, at large deformation",
     R"(# An airless wheel of a soft TPU with 20 curved spokes, for 100 kg: large deformation.

title = "Soft spokes"

[wheel]
outer_radius = "200 mm"
inner_radius = "110 mm"
width = "80 mm"
sectors = 20

[material]
youngs_modulus = "26 MPa"   # TPU of about 85 Shore A
poissons_ratio = 0.48
model = "neo_hookean"

[load]
mass = "100 kg"
positions = 4

[[shape.annulus]]

[[shape.spoke]]
kind = "curved"
count = 20
thickness = "12 mm"
angle = 10
bend = 30

[optimizer]
rim_band = "8 mm"
tread_band = "8 mm"

[grid]
radial_cells = 28
angular_cells = 400
)"},
    {"robot", "the printed wheel of a robot, for 4 kg, at large deformation",
     R"(# The wheel of a robot, printed from a soft TPU, 130 mm in diameter, for 4 kg: large deformation.

title = "Robot"

[wheel]
outer_radius = "65 mm"
inner_radius = "30 mm"
width = "30 mm"
sectors = 12

[material]
youngs_modulus = "12 MPa"   # TPU of 85 Shore A, printed
poissons_ratio = 0.48
plane = "stress"
model = "neo_hookean"

[load]
mass = "4 kg"
positions = 4

[[shape.annulus]]

[[shape.spoke]]
kind = "curved"
count = 12
thickness = "4 mm"
angle = 15
bend = 50

[optimizer]
rim_band = "4 mm"
tread_band = "4 mm"

[grid]
radial_cells = 24
angular_cells = 240
)"},
    {"rubber16", "the wheel of the paper in rubber, for 300 kg, at large deformation",
     R"(# The wheel of the paper in rubber, for 300 kg: large deformation.

title = "16 holes, rubber"

[material]
youngs_modulus = "8 MPa"
poissons_ratio = 0.48
model = "neo_hookean"

[load]
mass = "300 kg"
positions = 4

[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.03

[optimizer]
rim_band = "10.1 mm"
tread_band = "20.1 mm"

[grid]
radial_cells = 14
angular_cells = 192
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
    {"caster-tyre", "a caster of 200 mm, polyurethane on aluminium, for 250 kg",
     R"(# A caster of 200 mm x 50 mm: a tyre of polyurethane, 10 mm thick, bonded to a core of aluminium with holes.

title = "Caster with a tyre"

[wheel]
inner_radius = 0.02
outer_radius = 0.1
width = 0.05
sectors = 8

[material]
youngs_modulus = 70e9
poissons_ratio = 0.33
density = 2700

[[material.layer]]
name = "tyre"
inner_radius = 0.09
youngs_modulus = 40e6
poissons_ratio = 0.48
density = 1200
holes = "none"

[load]
mass = 250

[[holes.ring]]
count = 8
center_radius = 0.056
radius = 0.014

[grid]
radial_cells = 32
angular_cells = 384
)"},
    {"resilient-tram", "a steel wheel of a tram with rubber between hub and tyre",
     R"(# A resilient wheel of a tram: rubber between the steel of the hub and the steel of the tyre. The hub has holes.

title = "Resilient tram wheel"

[wheel]
inner_radius = 0.1
outer_radius = 0.33
width = 0.1
sectors = 12

[material]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7850

[[material.layer]]
name = "rubber"
inner_radius = 0.23
outer_radius = 0.26
youngs_modulus = 15e6
poissons_ratio = 0.49
density = 1150
holes = "none"

[[material.layer]]
name = "tyre"
inner_radius = 0.26
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7850
holes = "none"

[load]
force = 50e3

[[holes.ring]]
count = 12
center_radius = 0.165
radius = 0.03

[grid]
radial_cells = 46
angular_cells = 480
)"},
    {"shear-band", "an airless tyre: soft spokes, a stiff shear band, a rubber tread",
     R"(# An airless tyre: soft spokes carry a stiff shear band below a rubber tread.

title = "Shear band"

[wheel]
inner_radius = 0.2
outer_radius = 0.3
width = 0.16
sectors = 24

[material]
youngs_modulus = 80e6
poissons_ratio = 0.45
density = 1200

[[material.layer]]
name = "band"
inner_radius = 0.28
outer_radius = 0.29
youngs_modulus = 2e9
poissons_ratio = 0.35
density = 1500
holes = "none"

[[material.layer]]
name = "tread"
inner_radius = 0.29
youngs_modulus = 10e6
poissons_ratio = 0.49
density = 1150
holes = "none"

[load]
mass = 150

[[shape.annulus]]
outer_radius = 0.28

[[shape.spoke]]
kind = "curved"
count = 24
thickness = 0.008
angle = 8
bend = 30

[grid]
radial_cells = 40
angular_cells = 576
)"},
    {"nip-roller", "a rubber-covered roller in a nip, pressed on a steel roll",
     R"(# A roller of 120 mm x 400 mm in a nip: rubber on an extruded core of aluminium, pressed on a steel roll of 150 mm.

title = "Nip roller"

[wheel]
inner_radius = 0.015
outer_radius = 0.06
width = 0.4
sectors = 8

[material]
youngs_modulus = 70e9
poissons_ratio = 0.33
density = 2700

[[material.layer]]
name = "cover"
inner_radius = 0.048
youngs_modulus = 6e6
poissons_ratio = 0.49
density = 1200
holes = "none"

[load]
force = 1200
ground = "drum"
ground_radius = 0.075

[[holes.ring]]
count = 8
center_radius = 0.032
radius = 0.009

[grid]
radial_cells = 30
angular_cells = 384
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
