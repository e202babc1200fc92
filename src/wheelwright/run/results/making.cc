#include "wheelwright/run/results/making.h"

#include "wheelwright/case/derived.h"
#include "wheelwright/case/manufacture_words.h"
#include "wheelwright/output/report/shape_boundary.h"

namespace wheelwright {

namespace {

/// Without what is measured on the surface.
MadeWheel made_as_asked(const Case& c) {
  return {std::string(manufacture_words[static_cast<std::size_t>(c.optimizer.made)])};
}

}  // namespace

MadeWheel made_wheel(const Case& c, const SurfaceMesh& surface) {
  MadeWheel made = made_as_asked(c);
  if (const auto of_case = mould(c)) {
    const PolarGrid<3> grid = polar_grid<3>(c);
    const double plane = parting_plane_of(*of_case, grid) * grid.axial_size();
    made.mould = {plane, c.optimizer.draft, smallest_draft(surface, plane)};
  }
  if (const auto of_case = print(c)) {
    const double plate = of_case->plate == SideFace::smaller_z ? 0 : c.wheel.width;
    made.print = {plate, std::atan(of_case->slope), largest_overhang(surface, of_case->plate)};
  }
  return made;
}

template <>
std::optional<MadeWheel> made_wheel(const Case&, const LevelSet<2>&) {
  return {};
}

template <>
std::optional<MadeWheel> made_wheel(const Case& c, const LevelSet<3>& shape) {
  return mould(c) || print(c) ? made_wheel(c, shape_boundary(shape, c.grid.degree)) : made_as_asked(c);
}

SideFace shown_side_face(const Case& c) {
  const auto layers = print(c);
  return layers && layers->plate == SideFace::larger_z ? SideFace::smaller_z : SideFace::larger_z;
}

}  // namespace wheelwright
