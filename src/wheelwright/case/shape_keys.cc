#include "wheelwright/case/common_keys.h"

namespace wheelwright {

const SectionArray<CircleShape>& circle_shape_sections() {
  static const SectionArray<CircleShape> sections{
      .parent = "shape",
      .name = "circle",
      .meaning =
          "a circle, repeated about the axle; all `[[shape.*]]` are drawn over the ring and its "
          "`[[holes.*]]` in the order in which they are written",
      .in = [](Case& c) -> std::vector<CircleShape>& { return c.shapes.circles; },
      .example = {.count = 16, .center_radius = 0.27, .radius = 0.03},
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
      .example = {.count = 16, .center_radius = 0.27, .length = 0.09, .width = 0.05},
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
      .example = {.count = 16, .center_radius = 0.27, .length = 0.1, .width = 0.04},
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
                      "azimuth 0 is along x; or the name of a CSV file with these two columns",
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
      .example = {},
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
      .example = {.count = 16, .thickness = 0.02},
      .keys = {
          fill_key<SpokeShape>(choice<&SpokeShape::as>({"material", "hole"})),
          {.name = "kind",
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
          .field = TextField<Struct>{&Struct::path, ""},
          .meaning = meaning,
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> copies_key(std::string_view meaning) {
  return {
      .name = "count", .field = IntegerField<Struct>{&Struct::count, between(1, 100000)}, .meaning = meaning};
}

template <class Struct>
Key<Struct> checksum_key() {
  return {.name = "checksum",
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
           .field = choice<&FileShape::unit>({"file", "m", "cm", "mm", "in"}),
           .meaning = "unit of the numbers in the drawing; file: the file must say it"},
          {.name = "axle",
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
           .field = NumberField<PictureShape>{&PictureShape::threshold, between(0.01, 0.99)},
           .meaning = "what is darker is drawn; 0 is white and 1 is black"},
          copies_key<PictureShape>("how often the picture is repeated round the full wheel"),
          angle_key(&PictureShape::phase, "phase", "turns the picture towards larger azimuth"),
          checksum_key<PictureShape>()}};
  return sections;
}

}  // namespace wheelwright
