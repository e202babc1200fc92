#include "wheelwright/case/common_keys.h"

namespace wheelwright {

const SectionArray<HoleRing>& ring_sections() {
  static const SectionArray<HoleRing> sections{
      .parent = "holes",
      .name = "ring",
      .meaning =
          "holes of the initial shape: equal circles, evenly spaced about the axle; give any number of rings",
      .in = [](Case& c) -> std::vector<HoleRing>& { return c.holes.rings; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.04},
      .keys = {count_key<HoleRing>(), center_radius_key<HoleRing>(),
               length_key(&HoleRing::radius, "radius", "radius of each hole"),
               phase_key<HoleRing>(phase_of_centre)}};
  return sections;
}

const SectionArray<HoleCircle>& circle_sections() {
  static const SectionArray<HoleCircle> sections{
      .parent = "holes",
      .name = "circle",
      .meaning = "holes of the initial shape: a circle, repeated in every sector; give any number of circles",
      .in = [](Case& c) -> std::vector<HoleCircle>& { return c.holes.circles; },
      .example = {.center = {0.29, 0.02}, .radius = 0.01},
      .keys = {
          {.name = "center",
           .unit = "m",
           .field = PointField<HoleCircle>{&HoleCircle::center, between(-1000, 1000)},
           .meaning = "[x, y] of the centre in one sector; the axle is at [0, 0], and azimuth 0 is along x",
           .presence = Presence::required},
          length_key(&HoleCircle::radius, "radius", "radius of the hole")}};
  return sections;
}

const SectionArray<HoleSphere>& sphere_sections() {
  static const SectionArray<HoleSphere> sections{
      .parent = "holes",
      .name = "sphere",
      .meaning =
          "in 3D, spherical holes of the initial shape, evenly spaced about the axle; give any number of "
          "them",
      .in = [](Case& c) -> std::vector<HoleSphere>& { return c.holes.spheres; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.03, .z = 0},
      .keys = {count_key<HoleSphere>(),
               center_radius_key<HoleSphere>(),
               length_key(&HoleSphere::radius, "radius", "radius of each hole"),
               {.name = "z",
                .unit = "m",
                .field = NumberField<HoleSphere>{&HoleSphere::z, between(-1000, 1000)},
                .meaning = "position of the centres along the axle, from the middle of the width"},
               phase_key<HoleSphere>(phase_of_centre)}};
  return sections;
}

namespace {

HoleTapered conical_holes() {
  HoleTapered holes{.count = 16, .center_radius = 0.27, .profile = {}};
  holes.profile = {{-0.06, 0.04}, {0, 0.03}, {0.06, 0.04}};
  return holes;
}

}  // namespace

const SectionArray<HoleTapered>& tapered_sections() {
  static const SectionArray<HoleTapered> sections{
      .parent = "holes",
      .name = "tapered",
      .meaning =
          "in 3D, round holes of the initial shape whose radius changes along the axle, evenly spaced about "
          "it; give any number of them",
      .in = [](Case& c) -> std::vector<HoleTapered>& { return c.holes.tapered; },
      .example = conical_holes(),
      .keys = {
          count_key<HoleTapered>(),
          center_radius_key<HoleTapered>(),
          {.name = "profile",
           .unit = "m",
           .field = PointsField<HoleTapered>{&HoleTapered::profile, between(-1000, 1000)},
           .meaning = "[[z, radius], ...]: the radius along the axle, linear between the points and "
                      "constant beyond the ends; z is measured from the middle of the width and "
                      "increases; where the radius is negative there is no hole; or the name of a CSV file "
                      "with these two columns",
           .presence = Presence::required},
          phase_key<HoleTapered>(phase_of_centre)}};
  return sections;
}

const SectionArray<HoleGroove>& groove_sections() {
  static const SectionArray<HoleGroove> sections{
      .parent = "holes",
      .name = "groove",
      .meaning =
          "in 3D, grooves around the axle in the side faces of the initial shape; give any number of them",
      .in = [](Case& c) -> std::vector<HoleGroove>& { return c.holes.grooves; },
      .example = {.inner_radius = 0.23, .outer_radius = 0.31, .depth = 0.03},
      .keys = {
          length_key(&HoleGroove::inner_radius, "inner_radius", "radius of its inner side"),
          length_key(&HoleGroove::outer_radius, "outer_radius", "radius of its outer side"),
          length_key(&HoleGroove::depth, "depth", "how far it reaches into the wheel along the axle"),
          {.name = "outer_depth",
           .unit = "m",
           .field = OptionalNumberField<HoleGroove>{&HoleGroove::outer_depth, between(0, 1000), "depth"},
           .meaning = "the depth at its outer side, if the floor leans: from the depth at the inner side it "
                      "changes linearly"},
          {.name = "fillet",
           .unit = "m",
           .field = OptionalNumberField<HoleGroove>{&HoleGroove::fillet, between(0, 1000),
                                                    "half of the largest one that fits"},
           .meaning =
               "radius of its corners, for which the groove must have room: at most half of its width and, "
               "unless the floor leans, the depth"},
          {.name = "side",
           .field = choice<&HoleGroove::side>({"both", "smaller_z", "larger_z"}),
           .meaning =
               "which side faces have it: both, or that at the smaller or larger position along the axle"}}};
  return sections;
}

}  // namespace wheelwright
