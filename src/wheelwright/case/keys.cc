#include "wheelwright/case/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "wheelwright/base/text.h"
#include "wheelwright/case/number_text.h"

namespace wheelwright {

namespace {
constexpr double standard_gravity = 9.81;  // as the paper takes it [m/s^2]
constexpr double degree_of_arc = std::numbers::pi / 180;
constexpr Range length = between(1e-6, 1000);
constexpr Range cell_count = between(1, 100000);
}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_end == End::closed ? value >= low : value > low) &&
         (high_end == End::closed ? value <= high : value < high);
}

std::string Range::text() const {
  return fmt::format("{} {} value {} {}", number_text(low), low_end == End::closed ? "<=" : "<",
                     high_end == End::closed ? "<=" : "<", number_text(high));
}

bool keeps(TextRule rule, const std::string& text) {
  if (rule == TextRule::any) return true;
  const std::filesystem::path path = text;
  return path.is_relative() && without_control_characters(text) == text &&
         std::find(path.begin(), path.end(), "..") == path.end();
}

std::string_view rule_text(TextRule rule) {
  return rule == TextRule::any ? "text" : "a relative path without .. or control characters";
}

const Section<Case>& general_section() {
  static const Section<Case> section{
      .name = "",
      .meaning = "",
      .in = [](Case& c) -> Case& { return c; },
      .keys = {{.name = "title",
                .unit = "",
                .field = TextField<Case>{&Case::title, ""},
                .meaning = "one line of text, the title of pictures and reports"}}};
  return section;
}

const Section<Wheel>& wheel_section() {
  static const Section<Wheel> section{
      .name = "wheel",
      .meaning = "dimensions of the ring, and its number of equal sectors",
      .in = [](Case& c) -> Wheel& { return c.wheel; },
      .keys = {{.name = "dimension",
                .unit = "",
                .field = IntegerField<Wheel>{&Wheel::dimension, between(2, 3)},
                .meaning = "2: the plane of the wheel, the same over its whole width; 3: the wheel with its "
                           "width"},
               {.name = "inner_radius",
                .unit = "m",
                .field = NumberField<Wheel>{&Wheel::inner_radius, length},
                .meaning = "R_i: radius at which the structure is bonded to the rigid rim"},
               {.name = "outer_radius",
                .unit = "m",
                .field = NumberField<Wheel>{&Wheel::outer_radius, length},
                .meaning = "R_e: radius of the tread, which rolls on flat ground"},
               {.name = "width",
                .unit = "m",
                .field = NumberField<Wheel>{&Wheel::width, length},
                .meaning = "w_r: width along the axle"},
               {.name = "sectors",
                .unit = "",
                .field = IntegerField<Wheel>{&Wheel::sectors, between(1, 10000)},
                .meaning = "N_s: number of equal sectors of the shape; 1 means no cyclic symmetry"},
               {.name = "side_faces",
                .unit = "",
                .field = choice<&Wheel::side_faces>({"free", "symmetric"}),
                .meaning = "in 3D; free: nothing acts on the side faces; symmetric: they do not move along "
                           "the axle, as in a slice of a much wider wheel, which is plane strain where the "
                           "shape does not change along the axle"}}};
  return section;
}

const Section<Material>& material_section() {
  static const Section<Material> section{
      .name = "material",
      .meaning = "linear isotropic elasticity",
      .in = [](Case& c) -> Material& { return c.material; },
      .keys = {
          {.name = "youngs_modulus",
           .unit = "Pa",
           .field = NumberField<Material>{&Material::youngs_modulus, above(0, 1e13)},
           .meaning = "E: Young's modulus"},
          {.name = "poissons_ratio",
           .unit = "",
           .field = NumberField<Material>{&Material::poissons_ratio, at_least_and_below(0, 0.5)},
           .meaning = "nu: Poisson's ratio; at most 0.49999 and, above 0.485, with grid.degree = 2, "
                      "if plane = \"strain\""},
          {.name = "plane",
           .unit = "",
           .field = choice<&Material::plane>({"strain", "stress"}),
           .meaning = "strain: no strain along the axle, for wide wheels; stress: no stress along the "
                      "axle, for wheels cut from sheet"},
          {.name = "density",
           .unit = "kg/m^3",
           .field = OptionalNumberField<Material>{&Material::density, above(0, 1e5), "no mass is told"},
           .meaning = "for the mass of the wheel, and where a case minimizes or bounds it; load.body_force "
                      "has its weight"}}};
  return section;
}

const Section<Load>& load_section() {
  static const Section<Load> section{
      .name = "load",
      .meaning = "the load on the wheel, the same in all load positions",
      .in = [](Case& c) -> Load& { return c.load; },
      .keys = {
          {.name = "mass",
           .unit = "kg",
           .field = NumberField<Load>{&Load::force, between(1e-9, 1e9), standard_gravity},
           .meaning = "mass carried by the whole width, under 9.81 m/s^2"},
          {.name = "force",
           .unit = "N",
           .field = NumberField<Load>{&Load::force, between(1e-8, 1e10)},
           .meaning = "force carried by the whole width",
           .instead_of = "mass"},
          {.name = "travel",
           .unit = "m",
           .field = OptionalNumberField<Load>{&Load::travel, above(0, 1000), "the rim carries the load"},
           .meaning = "prescribed travel of the rim towards the ground; the force is a result",
           .instead_of = "mass"},
          {.name = "horizontal_force",
           .unit = "N",
           .field = NumberField<Load>{&Load::horizontal_force, between(-1e10, 1e10)},
           .meaning = "force on the rim along the ground, towards larger azimuth, on the whole width; "
                      "if it is 0 the rim does not move along the ground"},
          {.name = "lateral_force",
           .unit = "N",
           .field = NumberField<Load>{&Load::lateral_force, between(-1e10, 1e10)},
           .meaning = "in 3D, force on the rim along the axle, towards larger z; if it is 0 the rim does "
                      "not move along the axle"},
          {.name = "camber",
           .unit = "deg",
           .field = NumberField<Load>{&Load::camber, between(-30, 30), degree_of_arc},
           .meaning = "in 3D, the angle by which the wheel leans: its side at larger z is nearer to the "
                      "ground"},
          {.name = "torque",
           .unit = "N m",
           .field = NumberField<Load>{&Load::torque, between(-1e10, 1e10)},
           .meaning = "driving or braking torque on the rim, towards larger azimuth, on the whole "
                      "width; if it is 0 the rim does not turn"},
          {.name = "body_force",
           .unit = "N/m^3",
           .field = PointField<Load>{&Load::body_force, between(-1e12, 1e12)},
           .meaning = "[along, down]: force per volume of the structure, along the ground towards "
                      "larger azimuth, and downwards; [0, 9.81 * density] is its weight"},
          {.name = "hole_pressure",
           .unit = "Pa",
           .field = NumberField<Load>{&Load::hole_pressure, between(-1e12, 1e12)},
           .meaning = "pressure p on the boundary of the holes: g_N = -p n in (1)"},
          {.name = "speed",
           .unit = "m/s",
           .field = NumberField<Load>{&Load::speed, between(0, 1000)},
           .meaning = "speed v of the axle along the ground: the material is pulled away from the axle by "
                      "density (v / R_e)^2 r per volume; needs material.density"},
          {.name = "positions",
           .unit = "",
           .field = IntegerField<Load>{&Load::positions, between(1, 1000)},
           .meaning = "N_d: number of load positions per sector, any on any grid"}}};
  return section;
}

namespace {

CaseLoad example_load_case() {
  CaseLoad kerb;
  kerb.name = "kerb";
  kerb.force = 600 * standard_gravity;
  return kerb;
}

}  // namespace

const SectionArray<CaseLoad>& load_case_sections() {
  static const SectionArray<CaseLoad> sections{
      .parent = "load",
      .name = "case",
      .meaning =
          "one of several loads under which the wheel is optimized, all of them with one "
          "factorization; what it does not give is that of [load]; the first one is the load of "
          "pictures, pressures and numbers without a load case ([several loads](optimization.md))",
      .in = [](Case& c) -> std::vector<CaseLoad>& { return c.load.cases; },
      .example = example_load_case(),
      .keys = {
          {.name = "name",
           .unit = "",
           .field = TextField<CaseLoad>{&CaseLoad::name, ""},
           .meaning =
               "a word of letters, digits, - and _, for constraints and for the columns of history.csv",
           .presence = Presence::required},
          {.name = "weight",
           .unit = "",
           .field = NumberField<CaseLoad>{&CaseLoad::weight, between(0, 1e9)},
           .meaning = "of what is minimized, under this load; 0: it counts in constraints alone"},
          {.name = "mass",
           .unit = "kg",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::force, between(1e-9, 1e9), "that of [load]",
                                                  standard_gravity},
           .meaning = "mass carried by the whole width, under 9.81 m/s^2"},
          {.name = "force",
           .unit = "N",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::force, between(1e-8, 1e10), "that of [load]"},
           .meaning = "force carried by the whole width",
           .instead_of = "mass"},
          {.name = "travel",
           .unit = "m",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::travel, above(0, 1000), "that of [load]"},
           .meaning = "prescribed travel of the rim towards the ground",
           .instead_of = "mass"},
          {.name = "horizontal_force",
           .unit = "N",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::horizontal_force, between(-1e10, 1e10),
                                                  "that of [load]"},
           .meaning = "force on the rim along the ground"},
          {.name = "torque",
           .unit = "N m",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::torque, between(-1e10, 1e10), "that of [load]"},
           .meaning = "driving or braking torque on the rim"},
          {.name = "body_force",
           .unit = "N/m^3",
           .field =
               OptionalPointField<CaseLoad>{&CaseLoad::body_force, between(-1e12, 1e12), "that of [load]"},
           .meaning = "[along, down]: force per volume of the structure"},
          {.name = "hole_pressure",
           .unit = "Pa",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::hole_pressure, between(-1e12, 1e12),
                                                  "that of [load]"},
           .meaning = "pressure on the boundary of the holes"},
          {.name = "speed",
           .unit = "m/s",
           .field = OptionalNumberField<CaseLoad>{&CaseLoad::speed, between(0, 1000), "that of [load]"},
           .meaning = "speed of the axle along the ground"}}};
  return sections;
}

const Section<Contact>& contact_section() {
  static const Section<Contact> section{
      .name = "contact",
      .meaning = "contact of the tread with the ground",
      .in = [](Case& c) -> Contact& { return c.contact; },
      .keys = {
          {.name = "with",
           .unit = "",
           .field = choice<&Contact::with>({"ground", "ring"}),
           .meaning = "what the tread meets: flat ground on which it rolls, or a rigid ring to which all of "
                      "it is bonded, as in a bushing; the load then presses the rim towards each load "
                      "position"},
          {.name = "method",
           .unit = "",
           .field = choice<&Contact::method>({"nitsche", "penalty"}),
           .meaning = "Nitsche's method (28) or penalty (22)"},
          {.name = "theta",
           .unit = "",
           .field = NumberField<Contact>{&Contact::theta, any_number},
           .meaning = "Nitsche's parameter; -1 works with any gamma_0, 0 and 1 need a large one"},
          {.name = "gamma_0",
           .unit = "",
           .field = NumberField<Contact>{&Contact::gamma_0, above(0, 1e9)},
           .meaning = "gamma = gamma_0 E / h_T, where h_T is the diameter of the contact cell; in plane "
                      "stress with E (1 + 2 nu) / (1 + nu)^2 for E"},
          {.name = "friction",
           .unit = "",
           .field = NumberField<Contact>{&Contact::friction, between(0, 10)},
           .meaning = "coefficient F of Coulomb's static friction (16)"},
          {.name = "quadrature_points",
           .unit = "",
           .field = IntegerField<Contact>{&Contact::quadrature_points, between(1, 20)},
           .meaning =
               "number of Gauss points on each contact face; in 3D along the ground, and along the axle "
               "at most degree + 1"}}};
  return section;
}

const SectionArray<HoleRing>& ring_sections() {
  static const SectionArray<HoleRing> sections{
      .parent = "holes",
      .name = "ring",
      .meaning =
          "holes of the initial shape: equal circles, evenly spaced about the axle; give any number of rings",
      .in = [](Case& c) -> std::vector<HoleRing>& { return c.holes.rings; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.04, .phase = {}},
      .keys = {{.name = "count",
                .unit = "",
                .field = IntegerField<HoleRing>{&HoleRing::count, between(1, 100000)},
                .meaning = "number of holes round the full wheel, a multiple of wheel.sectors",
                .presence = Presence::required},
               {.name = "center_radius",
                .unit = "m",
                .field = NumberField<HoleRing>{&HoleRing::center_radius, length},
                .meaning = "distance from the axle to the centres",
                .presence = Presence::required},
               {.name = "radius",
                .unit = "m",
                .field = NumberField<HoleRing>{&HoleRing::radius, length},
                .meaning = "radius of each hole",
                .presence = Presence::required},
               {.name = "phase",
                .unit = "deg",
                .field = OptionalNumberField<HoleRing>{&HoleRing::phase, between(-360, 360),
                                                       "half the spacing, 180 / count", degree_of_arc},
                .meaning = "azimuth of the first centre; the first sector begins at azimuth 0"}}};
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
          {.name = "radius",
           .unit = "m",
           .field = NumberField<HoleCircle>{&HoleCircle::radius, length},
           .meaning = "radius of the hole",
           .presence = Presence::required}}};
  return sections;
}

// Keys that shapes have in common.

namespace {

template <class Struct>
Key<Struct> fill_key(ChoiceField<Struct> field) {
  return {.name = "as",
          .unit = "",
          .field = std::move(field),
          .meaning = "what is drawn: material or a hole, over the shapes before it"};
}

template <class Struct>
Key<Struct> count_key() {
  return {.name = "count",
          .unit = "",
          .field = IntegerField<Struct>{&Struct::count, between(1, 100000)},
          .meaning = "how many, evenly spaced round the full wheel; a multiple of wheel.sectors",
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> center_radius_key() {
  return {.name = "center_radius",
          .unit = "m",
          .field = NumberField<Struct>{&Struct::center_radius, length},
          .meaning = "distance from the axle to the centres",
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> length_key(double Struct::*member, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .unit = "m",
          .field = NumberField<Struct>{member, length},
          .meaning = meaning,
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> angle_key(double Struct::*member, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .unit = "deg",
          .field = NumberField<Struct>{member, between(-360, 360), degree_of_arc},
          .meaning = meaning};
}

template <class Struct>
Key<Struct> radius_key(std::optional<double> Struct::*member, std::string_view name,
                       std::string_view default_text, std::string_view meaning) {
  return {.name = name,
          .unit = "m",
          .field = OptionalNumberField<Struct>{member, length, default_text},
          .meaning = meaning};
}

template <class Struct>
Key<Struct> phase_key(std::string_view meaning) {
  return {.name = "phase",
          .unit = "deg",
          .field = OptionalNumberField<Struct>{&Struct::phase, between(-360, 360),
                                               "half the spacing, 180 / count", degree_of_arc},
          .meaning = meaning};
}

constexpr std::string_view phase_of_centre =
    "azimuth of the first centre; the first sector begins at azimuth 0";
constexpr std::string_view tilt =
    "from the direction away from the axle to the length, towards larger azimuth";

}  // namespace

const SectionArray<HoleSphere>& sphere_sections() {
  static const SectionArray<HoleSphere> sections{
      .parent = "holes",
      .name = "sphere",
      .meaning =
          "in 3D, spherical holes of the initial shape, evenly spaced about the axle; give any number of "
          "them",
      .in = [](Case& c) -> std::vector<HoleSphere>& { return c.holes.spheres; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.03, .z = 0, .phase = {}},
      .keys = {count_key<HoleSphere>(),
               center_radius_key<HoleSphere>(),
               length_key(&HoleSphere::radius, "radius", "radius of each hole"),
               {.name = "z",
                .unit = "m",
                .field = NumberField<HoleSphere>{&HoleSphere::z, between(-1000, 1000)},
                .meaning = "place of the centres along the axle, from the middle of the width"},
               phase_key<HoleSphere>(phase_of_centre)}};
  return sections;
}

namespace {

HoleTapered conical_holes() {
  HoleTapered holes{.count = 16, .center_radius = 0.27, .profile = {}, .phase = {}};
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
      .keys = {count_key<HoleTapered>(),
               center_radius_key<HoleTapered>(),
               {.name = "profile",
                .unit = "m",
                .field = PointsField<HoleTapered>{&HoleTapered::profile, between(-1000, 1000)},
                .meaning = "[[z, radius], ...]: the radius along the axle, straight from point to point and "
                           "constant beyond the ends; z is from the middle of the width and grows from point "
                           "to point; where the radius is negative there is no hole",
                .presence = Presence::required},
               phase_key<HoleTapered>(phase_of_centre)}};
  return sections;
}

const SectionArray<CircleShape>& circle_shape_sections() {
  static const SectionArray<CircleShape> sections{
      .parent = "shape",
      .name = "circle",
      .meaning =
          "a circle, repeated about the axle; all `[[shape.*]]` are drawn over the ring and its "
          "`[[holes.*]]` in the order in which they are written",
      .in = [](Case& c) -> std::vector<CircleShape>& { return c.shapes.circles; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.03, .phase = {}},
      .keys = {fill_key<CircleShape>(choice<&CircleShape::as>({"material", "hole"})),
               count_key<CircleShape>(), center_radius_key<CircleShape>(),
               length_key(&CircleShape::radius, "radius", "radius of each"),
               phase_key<CircleShape>(phase_of_centre)}};
  return sections;
}

const SectionArray<EllipseShape>& ellipse_shape_sections() {
  static const SectionArray<EllipseShape> sections{
      .parent = "shape",
      .name = "ellipse",
      .meaning = "an ellipse, repeated about the axle",
      .in = [](Case& c) -> std::vector<EllipseShape>& { return c.shapes.ellipses; },
      .example = {.count = 16, .center_radius = 0.27, .length = 0.09, .width = 0.05, .phase = {}},
      .keys = {fill_key<EllipseShape>(choice<&EllipseShape::as>({"material", "hole"})),
               count_key<EllipseShape>(), center_radius_key<EllipseShape>(),
               length_key(&EllipseShape::length, "length", "one axis, from end to end"),
               length_key(&EllipseShape::width, "width", "the other axis, from end to end"),
               angle_key(&EllipseShape::angle, "angle", tilt), phase_key<EllipseShape>(phase_of_centre)}};
  return sections;
}

const SectionArray<SlotShape>& slot_shape_sections() {
  static const SectionArray<SlotShape> sections{
      .parent = "shape",
      .name = "slot",
      .meaning = "a straight slot with round ends, repeated about the axle",
      .in = [](Case& c) -> std::vector<SlotShape>& { return c.shapes.slots; },
      .example = {.count = 16, .center_radius = 0.27, .length = 0.1, .width = 0.04, .phase = {}},
      .keys = {fill_key<SlotShape>(choice<&SlotShape::as>({"material", "hole"})), count_key<SlotShape>(),
               center_radius_key<SlotShape>(),
               length_key(&SlotShape::length, "length", "over all, from end to end"),
               length_key(&SlotShape::width, "width", "twice the radius of the ends; at most the length"),
               angle_key(&SlotShape::angle, "angle", tilt), phase_key<SlotShape>(phase_of_centre)}};
  return sections;
}

namespace {

PolygonShape example_polygon() {
  PolygonShape polygon;
  polygon.count = 16;
  polygon.points = {{0.23, 0.01}, {0.31, 0.02}, {0.3, 0.06}};
  return polygon;
}

}  // namespace

const SectionArray<PolygonShape>& polygon_shape_sections() {
  static const SectionArray<PolygonShape> sections{
      .parent = "shape",
      .name = "polygon",
      .meaning = "a polygon, repeated about the axle",
      .in = [](Case& c) -> std::vector<PolygonShape>& { return c.shapes.polygons; },
      .example = example_polygon(),
      .keys = {
          fill_key<PolygonShape>(choice<&PolygonShape::as>({"material", "hole"})),
          count_key<PolygonShape>(),
          {.name = "points",
           .unit = "m",
           .field = PointsField<PolygonShape>{&PolygonShape::points, between(-1000, 1000)},
           .meaning = "[[x, y], [x, y], ...]: corners of the first one, in order; the axle is at [0, 0], and "
                      "azimuth 0 is along x",
           .presence = Presence::required},
          angle_key(&PolygonShape::phase, "phase", "turns all of them towards larger azimuth")}};
  return sections;
}

const SectionArray<AnnulusShape>& annulus_shape_sections() {
  static const SectionArray<AnnulusShape> sections{
      .parent = "shape",
      .name = "annulus",
      .meaning = "everything between two radii; as a hole, which it is by default, it makes room for spokes",
      .in = [](Case& c) -> std::vector<AnnulusShape>& { return c.shapes.annuli; },
      .example = {.inner_radius = {}, .outer_radius = {}},
      .keys = {fill_key<AnnulusShape>(choice<&AnnulusShape::as>({"material", "hole"})),
               radius_key(&AnnulusShape::inner_radius, "inner_radius", "the edge of the band at the rim",
                          "where it begins"),
               radius_key(&AnnulusShape::outer_radius, "outer_radius", "the edge of the band at the tread",
                          "where it ends")}};
  return sections;
}

const SectionArray<SpokeShape>& spoke_shape_sections() {
  static const SectionArray<SpokeShape> sections{
      .parent = "shape",
      .name = "spoke",
      .meaning = "spokes of constant thickness, evenly spaced",
      .in = [](Case& c) -> std::vector<SpokeShape>& { return c.shapes.spokes; },
      .example = {.count = 16,
                  .thickness = 0.02,
                  .fork_radius = {},
                  .inner_radius = {},
                  .outer_radius = {},
                  .phase = {}},
      .keys = {
          fill_key<SpokeShape>(choice<&SpokeShape::as>({"material", "hole"})),
          {.name = "kind",
           .unit = "",
           .field = choice<&SpokeShape::kind>({"straight", "curved", "forked", "pair"}),
           .meaning = "curved: a circular arc; forked: two branches from a stem; pair: a straight spoke and "
                      "its mirror image"},
          count_key<SpokeShape>(),
          length_key(&SpokeShape::thickness, "thickness", "thickness of each spoke and branch"),
          angle_key(
              &SpokeShape::angle, "angle",
              "azimuth of the outer end minus that of the foot; of a pair's first spoke, which its mirror "
              "image reverses"),
          angle_key(&SpokeShape::bend, "bend",
                    "angle by which a curved spoke turns towards larger azimuth on its way outwards"),
          {.name = "spread",
           .unit = "deg",
           .field = NumberField<SpokeShape>{&SpokeShape::spread, between(0, 360), degree_of_arc},
           .meaning = "azimuth between the outer ends of a fork, or between the feet of a pair"},
          radius_key(&SpokeShape::fork_radius, "fork_radius", "halfway along the spoke",
                     "where a forked spoke divides"),
          radius_key(&SpokeShape::inner_radius, "inner_radius", "the rim", "where the feet are"),
          radius_key(&SpokeShape::outer_radius, "outer_radius", "the tread", "where the outer ends are"),
          phase_key<SpokeShape>("azimuth of the first foot, or of the middle of the first pair's feet")}};
  return sections;
}

namespace {

template <class Struct>
Key<Struct> path_key(std::string_view meaning) {
  return {.name = "path",
          .unit = "",
          .field = TextField<Struct>{&Struct::path, ""},
          .meaning = meaning,
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> copies_key(std::string_view meaning) {
  return {.name = "count",
          .unit = "",
          .field = IntegerField<Struct>{&Struct::count, between(1, 100000)},
          .meaning = meaning};
}

template <class Struct>
Key<Struct> checksum_key() {
  return {.name = "checksum",
          .unit = "",
          .field = TextField<Struct>{&Struct::checksum, "any file is taken"},
          .meaning = "CRC-32 of the file; another file is refused. Runs write it into their own case file"};
}

}  // namespace

const Section<SavedShape>& saved_shape_section() {
  static const Section<SavedShape> section{
      .name = "shape",
      .meaning = "the shape to begin with, if it is that of an earlier run ([saved shapes](shapes.md))",
      .in = [](Case& c) -> SavedShape& { return c.saved_shape; },
      .keys = {{.name = "from",
                .unit = "",
                .field = TextField<SavedShape>{&SavedShape::from, "holes and shapes are drawn"},
                .meaning = "the folder of a run, for its last saved shape, or a file of this kind "
                           "(shape.levelset); relative to the folder of the case file; the grid may differ, "
                           "the radii may not, and the number of sectors must divide that of the run"},
               checksum_key<SavedShape>()}};
  return section;
}

const SectionArray<FileShape>& file_shape_sections() {
  static const SectionArray<FileShape> sections{
      .parent = "shape",
      .name = "file",
      .meaning =
          "the closed outlines of a drawing, SVG or DXF, by the even-odd rule: an outline in another one "
          "cuts "
          "it out ([how drawings are read](shapes.md))",
      .in = [](Case& c) -> std::vector<FileShape>& { return c.shapes.files; },
      .example = {.path = "drawing.svg", .axle = {}, .checksum = {}, .drawing = {}},
      .keys = {
          fill_key<FileShape>(choice<&FileShape::as>({"material", "hole"})),
          path_key<FileShape>("the file, .svg or .dxf; relative to the folder of the case file"),
          {.name = "unit",
           .unit = "",
           .field = choice<&FileShape::unit>({"file", "m", "cm", "mm", "in"}),
           .meaning = "unit of the numbers in the drawing; file: the file must say it"},
          {.name = "axle",
           .unit = "",
           .field = OptionalPointField<FileShape>{&FileShape::axle, between(-1e9, 1e9),
                                                  "the centre of the page of an SVG, the origin of a DXF"},
           .meaning = "[x, y] of the axle in the drawing, in its own unit and axes"},
          copies_key<FileShape>(
              "how often the drawing is repeated round the full wheel; 1 if it shows all of it"),
          angle_key(&FileShape::phase, "phase", "turns the drawing towards larger azimuth"),
          checksum_key<FileShape>()}};
  return sections;
}

const SectionArray<PictureShape>& picture_shape_sections() {
  static const SectionArray<PictureShape> sections{
      .parent = "shape",
      .name = "picture",
      .meaning = "the dark pixels of a PNG are drawn; transparent ones are not",
      .in = [](Case& c) -> std::vector<PictureShape>& { return c.shapes.pictures; },
      .example = {.path = "picture.png", .width = 0.7, .checksum = {}, .picture = {}},
      .keys = {
          fill_key<PictureShape>(choice<&PictureShape::as>({"material", "hole"})),
          path_key<PictureShape>("the file, .png; relative to the folder of the case file"),
          {.name = "layout",
           .unit = "",
           .field = choice<&PictureShape::layout>({"wheel", "sector"}),
           .meaning =
               "wheel: the whole wheel, the axle in the middle; sector: one of `count` equal parts, "
               "unrolled, from the tread at the top to the rim at the bottom, azimuth growing to the right"},
          {.name = "width",
           .unit = "m",
           .field = OptionalNumberField<PictureShape>{&PictureShape::width, length,
                                                      "none, for a sector; required for a wheel"},
           .meaning = "width of the whole picture of a wheel"},
          {.name = "threshold",
           .unit = "",
           .field = NumberField<PictureShape>{&PictureShape::threshold, between(0.01, 0.99)},
           .meaning = "what is darker is drawn; 0 is white and 1 is black"},
          copies_key<PictureShape>("how often the picture is repeated round the full wheel"),
          angle_key(&PictureShape::phase, "phase", "turns the picture towards larger azimuth"),
          checksum_key<PictureShape>()}};
  return sections;
}

const Section<Grid>& grid_section() {
  static const Section<Grid> section{
      .name = "grid",
      .meaning = "uniform polar grid of the full ring",
      .in = [](Case& c) -> Grid& { return c.grid; },
      .keys = {
          {.name = "radial_cells",
           .unit = "",
           .field = IntegerField<Grid>{&Grid::radial_cells, cell_count},
           .meaning = "number of cells from rim to tread"},
          {.name = "angular_cells",
           .unit = "",
           .field = IntegerField<Grid>{&Grid::angular_cells, cell_count},
           .meaning = "number of cells round the full ring, a multiple of wheel.sectors"},
          {.name = "axial_cells",
           .unit = "",
           .field = IntegerField<Grid>{&Grid::axial_cells, cell_count},
           .meaning = "number of cells along the axle; in 3D; if it is even, a wheel that is its own mirror "
                      "image across the width is solved on half of it"},
          {.name = "degree",
           .unit = "",
           .field = IntegerField<Grid>{&Grid::degree, between(1, 2)},
           .meaning = "polynomial degree of the displacement"},
          {.name = "level_set_degree",
           .unit = "",
           .field = OptionalIntegerField<Grid>{&Grid::level_set_degree, between(1, 2), "2; in 3D 1", "auto"},
           .meaning = "polynomial degree of the level set"},
          {.name = "tread_levels",
           .unit = "",
           .field = OptionalIntegerField<Grid>{&Grid::tread_levels, between(0, 6),
                                               "8 cells across the contact patch in a run, 36 in an analysis "
                                               "and in the results of a run; in 3D 0",
                                               "auto"},
           .meaning =
               "how many times the cells at the tread are halved, for accurate contact pressures; the level "
               "set's grid and the cost of the cut cells do not change"}}};
  return section;
}

const Section<GhostPenalty>& ghost_penalty_section() {
  static const Section<GhostPenalty> section{
      .name = "ghost_penalty",
      .meaning = "stabilization of the cells that the boundary cuts",
      .in = [](Case& c) -> GhostPenalty& { return c.ghost_penalty; },
      .keys = {
          {.name = "kind",
           .unit = "",
           .field = choice<&GhostPenalty::kind>({"full", "paper"}),
           .meaning = "full: jumps of the stress and of the second normal derivative on all faces of cut "
                      "cells; paper: only the jump of the stress, by (81), which is unsafe for degree 2"},
          {.name = "xi",
           .unit = "",
           .field = NumberField<GhostPenalty>{&GhostPenalty::xi, between(0, 1)},
           .meaning = "weight; a large value stiffens the structure"}}};
  return section;
}

const Section<Objective>& objective_section() {
  static const Section<Objective> section{
      .name = "objective",
      .meaning =
          "weights of the functionals in the objective J, which is summed over all load positions and "
          "minimized",
      .in = [](Case& c) -> Objective& { return c.objective; },
      .keys = {
          {.name = "minimize",
           .unit = "",
           .field = choice<&Objective::minimize>({quantity_names.begin(), quantity_names.end()}),
           .meaning = "what is minimized; objective: the weighted sum; any other quantity takes its place, "
                      "and the weights then only say which functionals history.csv has"},
          {.name = "over",
           .unit = "",
           .field = choice<&Objective::over>({"mean", "worst"}),
           .meaning = "which load positions `minimize` is about: their mean, or the one with the greatest "
                      "value; not for the weighted sum"},
          {.name = "strain_energy",
           .unit = "",
           .field = NumberField<Objective>{&Objective::strain_energy, between(0, 1e9)},
           .meaning = "weight of the strain energy J_e (3)"},
          {.name = "uniformity_annulus",
           .unit = "",
           .field = NumberField<Objective>{&Objective::uniformity_annulus, between(0, 1e9)},
           .meaning = "weight alpha_1 of J_p1 (60): uniformity of the contact stress over the load "
                      "positions, in an annulus"},
          {.name = "uniformity_dual",
           .unit = "",
           .field = NumberField<Objective>{&Objective::uniformity_dual, between(0, 1e9)},
           .meaning = "weight alpha_2 of J_p2 (61): uniformity of the contact stress over the load "
                      "positions, in H^-1/2"},
          {.name = "uniformity_l2",
           .unit = "",
           .field = NumberField<Objective>{&Objective::uniformity_l2, between(0, 1e9)},
           .meaning = "weight of J_p (4), the naive uniformity functional; for comparison"},
          {.name = "annulus_matches_dual",
           .unit = "",
           .field = OptionalNumberField<Objective>{&Objective::annulus_matches_dual, above(0, 1e9),
                                                   "uniformity_annulus is used"},
           .meaning =
               "computes uniformity_annulus by (83): weighted J_p1 starts equal to J_p2 with this weight"},
          {.name = "annulus",
           .unit = "m",
           .field = OptionalNumberField<Objective>{&Objective::annulus, above(0, 1000), "one radial cell"},
           .meaning = "epsilon: thickness of the annulus of J_p1, a whole number of radial cells; it stays "
                      "material"},
          {.name = "length",
           .unit = "m",
           .field = OptionalNumberField<Objective>{&Objective::length, above(0, 1000), "epsilon"},
           .meaning = "L: characteristic length of J_p1 and J_p"},
          {.name = "mean",
           .unit = "",
           .field = choice<&Objective::mean>({"exact", "held"}),
           .meaning = "mean contact stress p_mean (73); exact: of the shape itself; held: of the last "
                      "accepted shape, as in the paper"},
          {.name = "dual_norm",
           .unit = "",
           .field = choice<&Objective::dual_norm>({"elasticity", "poisson"}),
           .meaning =
               "the problem on the ring without holes that defines the H^-1/2 norm of J_p2; elasticity: "
               "(68), as in the paper; poisson: Poisson's problem of Remark 7, with E in place of the "
               "elasticity tensor"}}};
  return section;
}

namespace {

Constraint example_constraint() {
  Constraint energy;
  energy.quantity = Quantity::strain_energy;
  energy.at_most = 5;
  return energy;
}

}  // namespace

const SectionArray<Constraint>& constraint_sections() {
  static const SectionArray<Constraint> sections{
      .parent = "",
      .name = "constraint",
      .meaning =
          "a bound that the optimized wheel must keep, with method = \"sequential_quadratic\"; a run that "
          "does "
          "not keep it ends with exit code 9; give any number of them, ten bounds in all; the volume is free "
          "when a bound, or what is minimized, is about volume_fraction or mass",
      .in = [](Case& c) -> std::vector<Constraint>& { return c.constraints; },
      .example = example_constraint(),
      .keys = {
          {.name = "quantity",
           .unit = "",
           .field = choice<&Constraint::quantity>({quantity_names.begin(), quantity_names.end()}),
           .meaning = "what is bounded, by the names of history.csv and [[expect]]",
           .presence = Presence::required},
          {.name = "at_least",
           .unit = "",
           .field = OptionalNumberField<Constraint>{&Constraint::at_least, above(0, 1e15), "no such bound"},
           .meaning = "lower bound, in SI units; of forces, energies, masses and stiffnesses in 2D per metre "
                      "of width, as in history.csv"},
          {.name = "at_most",
           .unit = "",
           .field = OptionalNumberField<Constraint>{&Constraint::at_most, above(0, 1e15), "no such bound"},
           .meaning = "upper bound"},
          {.name = "equals",
           .unit = "",
           .field = OptionalNumberField<Constraint>{&Constraint::equals, above(0, 1e15), "no such bound"},
           .meaning = "the value to keep, in place of bounds"},
          {.name = "over",
           .unit = "",
           .field = choice<&Constraint::over>({"mean", "worst", "each"}),
           .meaning = "which load positions it is about: their mean, the worst one, or each one with a "
                      "bound of its own"},
          {.name = "load_case",
           .unit = "",
           .field = TextField<Constraint>{&Constraint::load_case, "every load case"},
           .meaning = "the name of the [[load.case]] that it is about"}}};
  return sections;
}

const Section<Volume>& volume_section() {
  static const Section<Volume> section{
      .name = "volume",
      .meaning = "the volume constraint",
      .in = [](Case& c) -> Volume& { return c.volume; },
      .keys = {
          {.name = "control",
           .unit = "",
           .field = choice<&Volume::control>({"exact", "paper"}),
           .meaning = "exact: every shape has the target volume, once it is reached; paper: the rule "
                      "lambda_k of section 4.2, "
                      "which lets the volume drift"},
          {.name = "target",
           .unit = "",
           .field = OptionalNumberField<Volume>{&Volume::target, above(0, 1), "that of the initial shape"},
           .meaning = "material as a fraction of the ring; the run moves the volume there from that of the "
                      "initial shape"},
          {.name = "rate",
           .unit = "",
           .field = NumberField<Volume>{&Volume::rate, above(0, 1)},
           .meaning = "on the way to the target the volume changes by at most this fraction of the ring per "
                      "shape; only with control = \"exact\""}}};
  return section;
}

const Section<Optimizer>& optimizer_section() {
  static const Section<Optimizer> section{
      .name = "optimizer",
      .meaning =
          "the search for a better shape; the unit \"cell\" is the shortest edge of a grid cell at "
          "mid-ring",
      .in = [](Case& c) -> Optimizer& { return c.optimizer; },
      .keys = {
          {.name = "method",
           .unit = "",
           .field = choice<&Optimizer::method>({"auto", "sequential_quadratic", "descent"}),
           .meaning = "sequential_quadratic: steps of a quadratic model that learns the curvature from the "
                      "shapes before; descent: along the gradient; auto: descent with volume.control = "
                      "\"paper\" and "
                      "with velocity = \"harmonic\", which need it, else sequential_quadratic"},
          {.name = "iterations",
           .unit = "",
           .field = IntegerField<Optimizer>{&Optimizer::iterations, between(0, 1000000)},
           .meaning = "maximum number of accepted shapes after the initial one"},
          {.name = "coarse_levels",
           .unit = "",
           .field = IntegerField<Optimizer>{&Optimizer::coarse_levels, between(0, 4)},
           .meaning =
               "the descent begins on a grid whose cells are doubled so many times along each axis, and "
               "moves on to the next finer one when J has fallen by less than 0.5 % over 10 shapes, until "
               "it is on the case's own grid; 0: on the case's own grid from the beginning"},
          {.name = "velocity",
           .unit = "",
           .field = choice<&Optimizer::velocity>({"h1", "harmonic"}),
           .meaning = "h1: Riesz representative of the gradient; harmonic: the paper's harmonic extension"},
          {.name = "velocity_length",
           .unit = "cells",
           .field = NumberField<Optimizer>{&Optimizer::velocity_length, between(0, 1000)},
           .meaning = "length over which h1 smooths the velocity"},
          {.name = "step",
           .unit = "cells",
           .field = OptionalNumberField<Optimizer>{&Optimizer::step, above(0, 10),
                                                   "1.25; with method = \"descent\" 0.5"},
           .meaning = "maximum move of the boundary from one shape to the next"},
          {.name = "max_halvings",
           .unit = "",
           .field = IntegerField<Optimizer>{&Optimizer::max_halvings, between(0, 50)},
           .meaning = "how many times a rejected step is halved before the run stops"},
          {.name = "accepted_increase",
           .unit = "",
           .field = NumberField<Optimizer>{&Optimizer::accepted_increase, between(0, 1)},
           .meaning = "a shape is accepted if its J exceeds the best J so far by at most this fraction"},
          {.name = "tolerance",
           .unit = "",
           .field = NumberField<Optimizer>{&Optimizer::tolerance, between(0, 1)},
           .meaning =
               "the run stops when J has fallen by less than this fraction over 10 shapes; 0 means never"},
          {.name = "redistance_every",
           .unit = "shapes",
           .field = IntegerField<Optimizer>{&Optimizer::redistance_every, between(0, 1000000)},
           .meaning = "how often the level set is redistanced (made a signed distance again); 0 means never"},
          {.name = "smoothing",
           .unit = "cells^2",
           .field = NumberField<Optimizer>{&Optimizer::smoothing, between(0, 1000)},
           .meaning = "tau of (76); 0 means no smoothing, and then small holes may fray"},
          {.name = "smooth_every",
           .unit = "shapes",
           .field = IntegerField<Optimizer>{&Optimizer::smooth_every, between(1, 1000000)},
           .meaning = "how often the level set is smoothed by (76)"},
          {.name = "rim_band",
           .unit = "m",
           .field =
               OptionalNumberField<Optimizer>{&Optimizer::rim_band, between(0, 1000), "1/14 of the ring"},
           .meaning = "thickness of the band at the rim that stays material, at least one radial cell; holes "
                      "end on it, so that the "
                      "optimum depends on it"},
          {.name = "tread_band",
           .unit = "m",
           .field = OptionalNumberField<Optimizer>{&Optimizer::tread_band, between(0, 1000),
                                                   "1/14 of the ring, or 1/28 more than the annulus"},
           .meaning =
               "thickness of the band at the tread that stays material, at least one radial cell more than "
               "the annulus"},
          {.name = "minimum_wall",
           .unit = "m",
           .field = OptionalNumberField<Optimizer>{&Optimizer::minimum_wall, between(0, 1000),
                                                   "any at first, one cell in the last part of a run"},
           .meaning = "least thickness of the material between two edges: thinner walls are made as thick in "
                      "every shape; the bands at rim and tread must be as thick; 0 means any to the end"},
          {.name = "minimum_gap",
           .unit = "m",
           .field = OptionalNumberField<Optimizer>{&Optimizer::minimum_gap, between(0, 1000),
                                                   "any at first, one cell in the last part of a run"},
           .meaning =
               "least width of a hole: narrower parts of holes, and smaller holes, are filled in every "
               "shape; 0 means any to the end"},
          {.name = "nucleation",
           .unit = "",
           .field = choice<&Optimizer::nucleation>({"never", "converged"}),
           .meaning = "when holes are made where there are none: converged: where the search has converged, "
                      "small holes are made where the topological derivative says that they lower J most; "
                      "where J has not fallen when it has converged again, they are taken back and the run "
                      "ends; in two dimensions"}}};
  return section;
}

const Section<Output>& output_section() {
  static const Section<Output> section{
      .name = "output",
      .meaning = "the output of a run",
      .in = [](Case& c) -> Output& { return c.output; },
      .keys = {
          {.name = "folder",
           .unit = "",
           .field = TextField<Output>{&Output::folder, "runs/ and the name of the case file",
                                      TextRule::path_below},
           .meaning = "folder of the run, below the current one; the option --output takes any"},
          {.name = "vtu_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::vtu_every, between(0, 1000000)},
           .meaning = "how often fields are written for ParaView; 0 means never"},
          {.name = "pictures_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::pictures_every, between(0, 1000000)},
           .meaning =
               "how often the loaded wheel, its shape gradient and its level set are drawn in the folder "
               "shapes; 0 means never; the last shape is always drawn under load"},
          {.name = "checkpoint_every",
           .unit = "shapes",
           .field = IntegerField<Output>{&Output::checkpoint_every, between(0, 1000000)},
           .meaning = "how often the run is saved for `wheelwright resume`; 0 means only after "
                      "checkpoint_seconds"},
          {.name = "checkpoint_seconds",
           .unit = "s",
           .field = NumberField<Output>{&Output::checkpoint_seconds, between(0, 1e9)},
           .meaning = "time after which the next shape is saved as well; 0 means never"}}};
  return section;
}

namespace {

Expectation example_expectation() {
  Expectation energy;
  energy.quantity = Quantity::strain_energy;
  energy.value = 35;
  energy.margin = 0.01;
  return energy;
}

}  // namespace

const SectionArray<Expectation>& expectation_sections() {
  static const SectionArray<Expectation> sections{
      .parent = "",
      .name = "expect",
      .meaning =
          "an expected result; a run that finds another value reports it and ends with exit "
          "code 7; give any number of them",
      .in = [](Case& c) -> std::vector<Expectation>& { return c.expectations; },
      .example = example_expectation(),
      .keys = {{.name = "quantity",
                .unit = "",
                .field = choice<&Expectation::quantity>({quantity_names.begin(), quantity_names.end()}),
                .meaning = "a column of history.csv",
                .presence = Presence::required},
               {.name = "value",
                .unit = "",
                .field = NumberField<Expectation>{&Expectation::value, above(0, 1e15)},
                .meaning = "expected value, in the unit of history.csv; stresses in Pa",
                .presence = Presence::required},
               {.name = "margin",
                .unit = "",
                .field = NumberField<Expectation>{&Expectation::margin, above(0, 1)},
                .meaning = "accepted deviation, relative to the value"},
               {.name = "iteration",
                .unit = "",
                .field = OptionalIntegerField<Expectation>{&Expectation::iteration, between(0, 1000000),
                                                           "the last shape"},
                .meaning = "number of the accepted shape; 0 is the initial shape"},
               {.name = "load_case",
                .unit = "",
                .field = TextField<Expectation>{&Expectation::load_case, "the first one"},
                .meaning = "the name of the [[load.case]] that it is about"}}};
  return sections;
}

}  // namespace wheelwright
