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
                      "counts"},
          {.name = "side_faces",
           .field = choice<&Wheel::side_faces>({"free", "symmetric"}),
           .meaning = "in 3D; free: no forces act on the side faces; symmetric: they do not move along the "
                      "axle, as in a slice of a much wider wheel, which is plane strain if the shape is "
                      "constant along the axle"}}};
  return section;
}

namespace {

constexpr Range modulus = above(0, 1e13), ratio = at_least_and_below(0, 0.5), densities = above(0, 1e5);
constexpr std::string_view meaning_of_ratio =
    "nu: Poisson's ratio; at most 0.49999 and, above 0.485, with grid.degree = 2, if plane = \"strain\"";

}  // namespace

const Section<Material>& material_section() {
  static const Section<Material> section{
      .name = "material",
      .meaning = "linear isotropic elasticity",
      .in = [](Case& c) -> Material& { return c.material; },
      .keys = {{.name = "youngs_modulus",
                .unit = "Pa",
                .field = NumberField<Material>{&Material::youngs_modulus, modulus},
                .meaning = "E: Young's modulus"},
               {.name = "poissons_ratio",
                .field = NumberField<Material>{&Material::poissons_ratio, ratio},
                .meaning = meaning_of_ratio},
               {.name = "plane",
                .field = choice<&Material::plane>({"strain", "stress"}),
                .meaning = "strain: no strain along the axle, for wide wheels; stress: no stress along the "
                           "axle, for wheels cut from sheet"},
               {.name = "density",
                .unit = "kg/m^3",
                .field = OptionalNumberField<Material>{&Material::density, densities, "no mass is shown"},
                .meaning = "for the mass of the wheel, also if it is minimized or bounded, and for "
                           "load.speed; the weight is set by load.body_force"}}};
  return section;
}

const SectionArray<MaterialLayer>& material_layer_sections() {
  static const SectionArray<MaterialLayer> sections{
      .parent = "material",
      .name = "layer",
      .meaning =
          "a ring of another material between two radii, bonded to what lies inside and outside of it: "
          "linear isotropic elasticity, in the plane of [material], which is the material of what lies "
          "in no layer; layers do not overlap, and their radii lie on lines of the grid, of which there are "
          "grid.radial_cells + 1 at equal distances",
      .in = [](Case& c) -> std::vector<MaterialLayer>& { return c.layers; },
      .example = {.name = "tyre", .inner_radius = 0.33, .youngs_modulus = 30e6, .poissons_ratio = 0.48},
      .keys = {{.name = "name",
                .field = TextField<MaterialLayer>{&MaterialLayer::name, "its number"},
                .meaning = "a word of letters, digits, - and _, for messages and names of files, e.g. tyre"},
               radius_key<MaterialLayer>(&MaterialLayer::inner_radius, "inner_radius", "wheel.inner_radius",
                                         "where the layer begins"),
               radius_key<MaterialLayer>(&MaterialLayer::outer_radius, "outer_radius", "wheel.outer_radius",
                                         "where it ends"),
               {.name = "youngs_modulus",
                .unit = "Pa",
                .field = NumberField<MaterialLayer>{&MaterialLayer::youngs_modulus, modulus},
                .meaning = "E: Young's modulus",
                .presence = Presence::required},
               {.name = "poissons_ratio",
                .field = NumberField<MaterialLayer>{&MaterialLayer::poissons_ratio, ratio},
                .meaning = meaning_of_ratio,
                .presence = Presence::required},
               {.name = "density",
                .unit = "kg/m^3",
                .field = OptionalNumberField<MaterialLayer>{&MaterialLayer::density, densities,
                                                            "no mass is shown"},
                .meaning = "for the mass of the wheel and for load.speed, which need that of every material"},
               {.name = "holes",
                .field = choice<&MaterialLayer::holes>({"allowed", "none"}),
                .meaning = "none: the layer stays solid, like a protected band of its thickness"}}};
  return sections;
}

}  // namespace wheelwright
