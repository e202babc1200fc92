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

const Section<Material>& material_section() {
  static const Section<Material> section{
      .name = "material",
      .meaning = "linear isotropic elasticity",
      .in = [](Case& c) -> Material& { return c.material; },
      .keys = {{.name = "youngs_modulus",
                .unit = "Pa",
                .field = NumberField<Material>{&Material::youngs_modulus, above(0, 1e13)},
                .meaning = "E: Young's modulus"},
               {.name = "poissons_ratio",
                .field = NumberField<Material>{&Material::poissons_ratio, at_least_and_below(0, 0.5)},
                .meaning = "nu: Poisson's ratio; at most 0.49999 and, above 0.485, with grid.degree = 2, "
                           "if plane = \"strain\""},
               {.name = "plane",
                .field = choice<&Material::plane>({"strain", "stress"}),
                .meaning = "strain: no strain along the axle, for wide wheels; stress: no stress along the "
                           "axle, for wheels cut from sheet"},
               {.name = "density",
                .unit = "kg/m^3",
                .field = OptionalNumberField<Material>{&Material::density, above(0, 1e5), "no mass is shown"},
                .meaning = "for the mass of the wheel, also if it is minimized or bounded, and for "
                           "load.speed; the weight is set by load.body_force"}}};
  return section;
}

}  // namespace wheelwright
