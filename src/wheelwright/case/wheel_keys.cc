#include "wheelwright/case/common_keys.h"

namespace wheelwright {

const Section<Case>& general_section() {
  static const Section<Case> section{
      .name = "",
      .meaning = "",
      .in = [](Case& c) -> Case& { return c; },
      .keys = {{.name = "title",
                .field = TextField<Case>{&Case::title, ""},
                .meaning = "one line of text, the title of pictures and reports"}}};
  return section;
}

const Section<Wheel>& wheel_section() {
  static const Section<Wheel> section{
      .name = "wheel",
      .meaning = "dimensions of the ring, and its number of equal sectors",
      .in = [](Case& c) -> Wheel& { return c.wheel; },
      .keys = {
          {.name = "dimension",
           .field = IntegerField<Wheel>{&Wheel::dimension, between(2, 3)},
           .meaning = "2: the plane of the wheel, constant over its width; 3: the wheel with its width"},
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
           .field = IntegerField<Wheel>{&Wheel::sectors, between(1, 10000)},
           .meaning = "N_s: number of equal sectors of the shape; 1 means no cyclic symmetry; in a case with "
                      "drawings or pictures the default is the largest number that fits them and all "
                      "counts, and with the shape of another run that of the run"},
          {.name = "side_faces",
           .field = choice<&Wheel::side_faces>({"free", "symmetric"}),
           .meaning = "in 3D; free: no forces act on the side faces; symmetric: they do not move along the "
                      "axle, as in a slice of a much wider wheel, which is plane strain if the shape is "
                      "constant along the axle"}}};
  return section;
}

namespace {

constexpr Range modulus = above(0, 1e13), ratio = at_least_and_below(0, 0.5), densities = above(0, 1e5),
                loss_factors = between(0, 2), conductivities = between(1e-3, 1e4),
                temperatures = between(-200, 2000), any_ratio = between(-100, 100);
constexpr std::string_view
    meaning_of_modulus =
        "E: Young's modulus of an isotropic material; an orthotropic one has youngs_modulus_radial and "
        "others",
    meaning_of_ratio =
        "nu: Poisson's ratio of an isotropic material; at most 0.49999 and, above 0.485, with "
        "grid.degree = 2, if plane = \"strain\"",
    meaning_of_loss_factor =
        "tan(delta): loss modulus by storage modulus, for the rolling resistance, which needs that of every "
        "material; 0 has no losses, and above about 0.3 the resistance is only a rough estimate; over the "
        "frequency [[Hz, tan(delta)], ...], linear over its logarithm and constant beyond the ends, at "
        "load.speed",
    meaning_of_conductivity =
        "thermal conductivity, the same along all axes, for the temperature of the rolling wheel, which "
        "needs that of every material and the section heat",
    meaning_of_maximum_temperature =
        "up to which the material may be used: where the wheel gets warmer, the results say so",
    isotropic = "the material is isotropic";

/// The constants of an orthotropic material, as keys of Struct.
template <class Struct>
std::vector<Key<Struct>> orthotropic_keys() {
  const auto number = [](std::optional<double> Struct::*member, const Range& range) {
    return OptionalNumberField<Struct>{member, range, isotropic};
  };
  return {{.name = "youngs_modulus_radial",
           .unit = "Pa",
           .field = number(&Struct::youngs_modulus_radial, modulus),
           .meaning = "E_r: Young's modulus along the radius of an orthotropic material, which also needs "
                      "all constants below; G_rz and G_tz only in 3D",
           .instead_of = "youngs_modulus"},
          {.name = "youngs_modulus_azimuthal",
           .unit = "Pa",
           .field = number(&Struct::youngs_modulus_azimuthal, modulus),
           .meaning = "E_t: Young's modulus along the azimuth"},
          {.name = "youngs_modulus_axial",
           .unit = "Pa",
           .field = number(&Struct::youngs_modulus_axial, modulus),
           .meaning = "E_z: Young's modulus along the axle"},
          {.name = "poissons_ratio_radial_azimuthal",
           .field = number(&Struct::poissons_ratio_radial_azimuthal, any_ratio),
           .meaning = "nu_rt: contraction along the azimuth by extension along the radius, under a stress "
                      "along the radius; nu_rt / E_r = nu_tr / E_t",
           .instead_of = "poissons_ratio"},
          {.name = "poissons_ratio_radial_axial",
           .field = number(&Struct::poissons_ratio_radial_axial, any_ratio),
           .meaning = "nu_rz: contraction along the axle, under a stress along the radius"},
          {.name = "poissons_ratio_azimuthal_axial",
           .field = number(&Struct::poissons_ratio_azimuthal_axial, any_ratio),
           .meaning = "nu_tz: contraction along the axle, under a stress along the azimuth"},
          {.name = "shear_modulus_radial_azimuthal",
           .unit = "Pa",
           .field = number(&Struct::shear_modulus_radial_azimuthal, modulus),
           .meaning = "G_rt: shear modulus in the plane of the wheel"},
          {.name = "shear_modulus_radial_axial",
           .unit = "Pa",
           .field = number(&Struct::shear_modulus_radial_axial, modulus),
           .meaning = "G_rz: shear modulus in planes through the axle; only in 3D"},
          {.name = "shear_modulus_azimuthal_axial",
           .unit = "Pa",
           .field = number(&Struct::shear_modulus_azimuthal_axial, modulus),
           .meaning = "G_tz: shear modulus in planes across the radius; only in 3D"}};
}

/// What a material bears over many turns, as keys of Struct.
template <class Struct>
std::vector<Key<Struct>> fatigue_keys() {
  const auto number = [](std::optional<double> Struct::*member, const Range& range, std::string_view absent) {
    return OptionalNumberField<Struct>{member, range, absent};
  };
  return {
      {.name = "fatigue_measure",
       .field = ChoiceField<Struct>{
           {"none", "crossland", "dang_van", "goodman", "principal_strain", "strain_energy"},
           [](const Struct& s) { return static_cast<int>(s.fatigue_measure); },
           [](Struct& s, int i) { s.fatigue_measure = static_cast<FatigueMeasure>(i); },
           [](const Struct& s) -> const void* { return &s.fatigue_measure; }},
       .meaning = "what of a turn's stresses or strains is compared with the fatigue limit: for metals "
                  "crossland (amplitude of the root of J2, and alpha times the largest hydrostatic stress) "
                  "or dang_van (largest shear stress about the mean, and alpha times the hydrostatic "
                  "stress); for plastics goodman (amplitude of the signed von Mises stress, raised by its "
                  "mean); for elastomers principal_strain or strain_energy, the largest ones"},
      {.name = "fatigue_limit",
       .unit = "Pa",
       .field = number(&Struct::fatigue_limit, modulus, "fatigue is not computed"),
       .meaning = "the measure that the material endures for fatigue_cycles; of strain_energy in J/m^3, "
                  "which are Pa; of principal_strain it is fatigue_strain"},
      {.name = "fatigue_strain",
       .field = number(&Struct::fatigue_strain, above(0, 10), "fatigue is not computed"),
       .meaning = "the principal strain that the material endures for fatigue_cycles"},
      {.name = "fatigue_cycles",
       .field = NumberField<Struct>{&Struct::fatigue_cycles, between(1, 1e12)},
       .meaning = "turns at the limit"},
      {.name = "fatigue_exponent",
       .field = number(&Struct::fatigue_exponent, above(0, 100), "no life is shown"),
       .meaning = "k of the life N = fatigue_cycles (limit / measure)^k in turns, the curve of Woehler"},
      {.name = "fatigue_pressure_factor",
       .field = number(&Struct::fatigue_pressure_factor, between(0, 10), "none"),
       .meaning = "alpha of crossland and dang_van"},
      {.name = "ultimate_strength",
       .unit = "Pa",
       .field = number(&Struct::ultimate_strength, modulus, "none"),
       .meaning = "R_m of goodman"}};
}

template <class Struct>
std::vector<Key<Struct>> large_strain_keys() {
  return {
      {.name = "model",
       .field =
           ChoiceField<Struct>{{"small_strain", "neo_hookean", "saint_venant_kirchhoff", "mooney_rivlin"},
                               [](const Struct& s) { return static_cast<int>(s.model); },
                               [](Struct& s, int i) { s.model = static_cast<MaterialModel>(i); },
                               [](const Struct& s) -> const void* { return &s.model; }},
       .meaning = "small_strain: linear elasticity; others, in 2D: large deformation, with these constants "
                  "for small strains. neo_hookean: rubber and other elastomers; mooney_rivlin: the same with "
                  "a second constant; saint_venant_kirchhoff: stiff materials that turn by much and strain "
                  "by little"},
      {.name = "second_share",
       .field = NumberField<Struct>{&Struct::second_share, between(0, 1)},
       .meaning = "c2 / (c1 + c2) of mooney_rivlin"}};
}

template <class Struct>
std::vector<Key<Struct>> heat_keys() {
  return {
      {.name = "conductivity",
       .unit = "W/(m K)",
       .field = OptionalNumberField<Struct>{&Struct::conductivity, conductivities, "no temperature is shown"},
       .meaning = meaning_of_conductivity},
      {.name = "maximum_temperature",
       .unit = "deg C",
       .field = OptionalNumberField<Struct>{&Struct::maximum_temperature, temperatures,
                                            "no temperature is too high"},
       .meaning = meaning_of_maximum_temperature}};
}

/// With the constants of an orthotropic material, of heat and of fatigue.
template <class Struct>
std::vector<Key<Struct>> with_further_constants(std::vector<Key<Struct>> keys) {
  for (auto& further :
       {large_strain_keys<Struct>(), heat_keys<Struct>(), orthotropic_keys<Struct>(), fatigue_keys<Struct>()})
    keys.insert(keys.end(), further.begin(), further.end());
  return keys;
}

Key<MaterialLayer> range_key(std::optional<std::array<double, 2>> MaterialLayer::*member,
                             std::string_view name, std::string_view meaning) {
  return {.name = name,
          .unit = "m",
          .field = OptionalPointField<MaterialLayer>{member, length, "the radius stays"},
          .meaning = meaning};
}

MaterialLayer example_of_a_layer() {
  MaterialLayer layer;
  layer.name = "tyre";
  layer.inner_radius = 0.33;
  layer.youngs_modulus = 30e6;
  layer.poissons_ratio = 0.48;
  return layer;
}

}  // namespace

const Section<RingMaterial>& material_section() {
  using Struct = RingMaterial;
  static const Section<Struct> section{
      .name = "material",
      .meaning =
          "elasticity: linear, isotropic or orthotropic with the axes radius, azimuth and axle; or of large "
          "strains",
      .in = [](Case& c) -> Struct& { return c.material; },
      .keys = with_further_constants<Struct>(
          {{.name = "youngs_modulus",
            .unit = "Pa",
            .field = NumberField<Struct>{&Struct::youngs_modulus, modulus},
            .meaning = meaning_of_modulus},
           {.name = "poissons_ratio",
            .field = NumberField<Struct>{&Struct::poissons_ratio, ratio},
            .meaning = meaning_of_ratio},
           {.name = "plane",
            .field = ChoiceField<Struct>{{"strain", "stress"},
                                         [](const Struct& s) { return static_cast<int>(s.plane); },
                                         [](Struct& s, int i) { s.plane = static_cast<Plane>(i); },
                                         [](const Struct& s) -> const void* { return &s.plane; }},
            .meaning = "strain: no strain along the axle, for wide wheels; stress: no stress along the "
                       "axle, for wheels cut from sheet"},
           {.name = "density",
            .unit = "kg/m^3",
            .field = OptionalNumberField<Struct>{&Struct::density, densities, "no mass is shown"},
            .meaning = "for the mass of the wheel, also if it is minimized or bounded, and for "
                       "load.speed; the weight is set by load.body_force"},
           {.name = "loss_factor",
            .field =
                LossFactorField<Struct>{&Struct::loss_factor, loss_factors, "no rolling resistance is shown"},
            .meaning = meaning_of_loss_factor}})};
  return section;
}

const SectionArray<MaterialLayer>& material_layer_sections() {
  static const SectionArray<MaterialLayer> sections{
      .parent = "material",
      .name = "layer",
      .meaning =
          "a ring of another material between two radii, bonded to what lies inside and outside of it: "
          "linear elasticity, isotropic or orthotropic, or a model of large strains, in the plane of "
          "[material], which is the material of what lies in no layer; layers do not overlap; rows of the "
          "grid end at their radii, and are "
          "equally "
          "high in between",
      .in = [](Case& c) -> std::vector<MaterialLayer>& { return c.layers; },
      .example = example_of_a_layer(),
      .keys = with_further_constants<MaterialLayer>(
          {{.name = "name",
            .field = TextField<MaterialLayer>{&MaterialLayer::name, "its number"},
            .meaning = "a word of letters, digits, - and _, for messages and names of files, e.g. tyre"},
           radius_key<MaterialLayer>(&MaterialLayer::inner_radius, "inner_radius", "wheel.inner_radius",
                                     "where the layer begins"),
           radius_key<MaterialLayer>(&MaterialLayer::outer_radius, "outer_radius", "wheel.outer_radius",
                                     "where it ends"),
           {.name = "youngs_modulus",
            .unit = "Pa",
            .field = NumberField<MaterialLayer>{&MaterialLayer::youngs_modulus, modulus},
            .meaning = meaning_of_modulus,
            .presence = Presence::required},
           {.name = "poissons_ratio",
            .field = NumberField<MaterialLayer>{&MaterialLayer::poissons_ratio, ratio},
            .meaning = meaning_of_ratio,
            .presence = Presence::required},
           {.name = "density",
            .unit = "kg/m^3",
            .field =
                OptionalNumberField<MaterialLayer>{&MaterialLayer::density, densities, "no mass is shown"},
            .meaning = "for the mass of the wheel and for load.speed, which need that of every material"},
           {.name = "loss_factor",
            .field = LossFactorField<MaterialLayer>{&MaterialLayer::loss_factor, loss_factors,
                                                    "no rolling resistance is shown"},
            .meaning = meaning_of_loss_factor},
           {.name = "holes",
            .field = choice<&MaterialLayer::holes>({"allowed", "none"}),
            .meaning = "none: the layer stays solid, like a protected band of its thickness"},
           range_key(&MaterialLayer::inner_radius_range, "inner_radius_range",
                     "[least, largest] radius where the layer may begin: wheelwright run chooses it together "
                     "with the shape, from inner_radius on"),
           range_key(&MaterialLayer::outer_radius_range, "outer_radius_range",
                     "the same where it may end; layers that meet keep meeting")})};
  return sections;
}

const SectionArray<MaterialCord>& material_cord_sections() {
  static const SectionArray<MaterialCord> sections{
      .parent = "material",
      .name = "cord",
      .meaning =
          "thin cords side by side along a circle, such as a belt: they resist only strain along the "
          "azimuth, and have no mass. A line of the grid moves to the circle, which lies in material that "
          "has "
          "no holes: a layer with holes = \"none\", or a band at rim or tread",
      .in = [](Case& c) -> std::vector<MaterialCord>& { return c.cords; },
      .example = {.radius = 0.335, .stiffness = 2e6},
      .keys = {length_key<MaterialCord>(&MaterialCord::radius, "radius", "radius of the circle"),
               {.name = "stiffness",
                .unit = "N/m",
                .field = NumberField<MaterialCord>{&MaterialCord::stiffness, above(0, 1e13)},
                .meaning = "E A: force by strain of the cords, per width along the axle",
                .presence = Presence::required}}};
  return sections;
}

}  // namespace wheelwright
